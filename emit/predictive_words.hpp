#pragma once
/// \file
/// What the comments of a predictive grammar say of an order: from how much it was told, what apices become, which course lengths follow. Private to this room.

#include "quantify/outlook.hpp"

#include <string>
#include <vector>

namespace axil::emit {

inline constexpr double kRare = 1e-3;  // fates rarer than this are left out

[[nodiscard]] std::vector<std::string> commentsFor(const quantify::OrderOutlook& order);

}  // namespace axil::emit
