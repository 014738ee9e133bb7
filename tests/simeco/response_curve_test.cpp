// Curves that classic texts ask with func(number, x), from the view file or a function file.

#include "simeco/response_curve.hpp"

#include "simeco/lsystem_derive.hpp"
#include "simeco/lsystem_language.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace axil::simeco {
namespace {

TEST(ResponseCurve, TwoPointsAreALineThreeAParabola) {
  const ResponseCurve line = responseCurve({0, 1, 1, 3}).value(), parabola = responseCurve({0, 0, 0.5, 1, 1, 0}).value();
  for (double x = 0; x <= 1; x += 0.125) {
    EXPECT_NEAR(line.at(x), 1 + 2 * x, 1e-12) << x;
    EXPECT_NEAR(parabola.at(x), 2 * x * (1 - x), 1e-12) << x;  // the Bezier curve of these points
  }
  EXPECT_EQ(line.at(-5), 1);
  EXPECT_EQ(line.at(7), 3);
}

TEST(ResponseCurve, ManyPointsMakeASmoothCurveFromTheFirstToTheLast) {
  const ResponseCurve step = responseCurve({0, 0, 0.2, 0, 0.4, 0, 0.6, 1, 0.8, 1, 1, 1}).value();
  EXPECT_EQ(step.at(0), 0);
  EXPECT_EQ(step.at(1), 1);
  EXPECT_NEAR(step.at(0.5), 0.5, 1e-12) << "the points are symmetric about the middle";
  double before = 0;
  for (double x = 0; x <= 1; x += 0.01) {
    EXPECT_GE(step.at(x), before - 1e-12) << x;
    EXPECT_LT(step.at(x) - before, 0.04) << "no jump at " << x;
    before = step.at(x);
  }
  const ResponseCurve straight = responseCurve({0, 2, 0.1, 2.1, 0.5, 2.5, 0.7, 2.7, 1, 3}).value();
  for (double x = 0; x <= 1; x += 0.05) EXPECT_NEAR(straight.at(x), 2 + x, 1e-12) << "points on a line";
}

TEST(ResponseCurve, WrongPointsAreRefused) {
  EXPECT_FALSE(responseCurve({0, 1}));
  EXPECT_FALSE(responseCurve({0, 1, 1}));
  EXPECT_NE(responseCurve({0, 0, 0.6, 1, 0.5, 1}).error().message.find("point 3"), std::string::npos);
  EXPECT_FALSE(responseCurve({0.5, 0, 0.5, 1}));
  EXPECT_FALSE(parseResponseCurve("0 0\n1 1\n"));
  EXPECT_NE(parseResponseCurve("points: 2\n0 0\n1 high\n").error().message.find("'high'"), std::string::npos);
}

constexpr const char* kAsks = "Lsystem: 1\nderivation length: 2\nAxiom: A(0)\nA(x) --> F(func(1,x))A(x+0.5)\nendlsystem\n";

std::string derived(const std::string& view, const std::filesystem::path& folder = {}) {
  const Parsed parsed = parseLSystem(kAsks);
  EXPECT_TRUE(parsed.ok());
  const ParsedView read = parseLSystemView(view, folder);
  EXPECT_FALSE(hasErrors(read.diagnostics)) << read.diagnostics.front().message;
  const auto derivation = deriveLSystem(parsed.grammar, {.derive = {}, .view = read.view});
  return derivation ? toText(derivation->string) : derivation.error().message;
}

TEST(ResponseCurve, AClassicTextAsksTheCurvesOfItsViewFile) {
  EXPECT_EQ(derived("function: 0 4  1 8\n"), "F(4)F(6)A(1)");
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "response_curve";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "growth.func") << "fver 1 1\nname: growth\nsamples: 20\nflip: off\npoints: 2\n0.0 2.0\n1.0 4.0\n";
  EXPECT_EQ(derived("function: growth.func\n", folder), "F(2)F(3)A(1)");
}

TEST(ResponseCurve, WhatIsNotThereIsSaidWhenItIsAsked) {
  EXPECT_NE(derived("").find("func(1, ...)"), std::string::npos);
  EXPECT_NE(derived("function: nowhere.func\n").find("no such function"), std::string::npos);
  EXPECT_NE(derived("function: ../../etc/passwd\n").find("no such function"), std::string::npos);
  EXPECT_TRUE(hasErrors(parseLSystemView("function: 0 0 1\n").diagnostics));
}

TEST(ResponseCurve, AHostThatAnswersCountsOverTheViewFile) {
  const Parsed parsed = parseLSystem(kAsks);
  DeriveLSystemOptions options{.derive = {}, .view = parseLSystemView("function: 0 4  1 8\n").view};
  options.derive.host.function = [](std::int64_t, std::span<const double>) -> Result<double> { return 1.0; };
  EXPECT_EQ(toText(deriveLSystem(parsed.grammar, options)->string), "F(1)F(1)A(1)");
}

}  // namespace
}  // namespace axil::simeco
