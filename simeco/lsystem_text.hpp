#pragma once
/// \file
/// A derived string as the classic program writes it: parameters with six significant digits.

#include "simeco/module_string.hpp"

#include <string>

namespace axil::simeco {

/// `F(1)[+(45)B(0.333333,1e+06)]`: numbers as printf's %g writes them, without line breaks. `toText` keeps all digits instead.
[[nodiscard]] std::string toLSystemText(const ModuleString& string);

}  // namespace axil::simeco
