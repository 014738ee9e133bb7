#pragma once
/// \file
/// Test data that stays outside the project: ../shared beside the source folder. Where it is missing a test skips and says so.

#include <gtest/gtest.h>

#include <filesystem>

namespace axil::test {

/// The path of a file or folder in ../shared; it may not exist.
[[nodiscard]] std::filesystem::path sharedPath(const std::filesystem::path& relative);

}  // namespace axil::test

/// First line of a test that needs `relative` in ../shared.
#define AXIL_SKIP_WITHOUT_SHARED(relative)                     \
  if (!std::filesystem::exists(::axil::test::sharedPath(relative))) \
  GTEST_SKIP() << "needs ../shared/" << (relative) << ", which is not here"
