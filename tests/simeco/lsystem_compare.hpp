#pragma once
/// \file
/// Derived strings of the classic language compared: letters equal, numbers as near as printing lets them be.

#include <string>

namespace axil::test {

/// Letters equal, numbers in parentheses within 1e-5 of each other (or `tolerance`); the first difference, else empty.
[[nodiscard]] std::string difference(const std::string& ours, const std::string& theirs, double tolerance);

}  // namespace axil::test
