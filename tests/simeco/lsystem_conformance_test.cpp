// What L-systems derive: the cases of lsystem/*.l, and every shared model against the string that the reference program wrote.

#include "base/files.hpp"
#include "lsystem_compare.hpp"
#include "simeco/lsystem_derive.hpp"
#include "simeco/lsystem_language.hpp"
#include "simeco/lsystem_text.hpp"
#include "support/shared_data.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

namespace axil::simeco {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

Grammar grammarOf(const fs::path& path) {
  Parsed parsed = parseLSystem(readFile(path).value(), {.include = includesBeside(path)});
  EXPECT_TRUE(parsed.ok()) << path << ": " << parsed.diagnostics.front().message;
  return std::move(parsed.grammar);
}

std::vector<fs::path> lFilesIn(const fs::path& folder) {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".l") paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  return paths;
}

TEST(LSystemDerivation, EachCaseDerivesTheStringThatItAnnounces) {
  int strings = 0;
  for (const fs::path& path : lFilesIn(fs::path(AXIL_TEST_DIR) / "lsystem")) {
    const std::string text = readFile(path).value();
    const std::string mark = "// expect: ";
    const std::size_t at = text.find(mark);
    if (at == std::string::npos) continue;
    std::string expected = text.substr(at + mark.size(), text.find('\n', at) - at - mark.size());
    std::erase(expected, '\r');
    DeriveLSystemOptions options;
    options.derive.host.files = filesBeside(path);
    const auto derived = deriveLSystem(grammarOf(path), options);
    ASSERT_TRUE(derived) << path.filename() << ": " << derived.error().message;
    EXPECT_EQ(toLSystemText(derived->string), expected) << path.filename();
    ++strings;
  }
  EXPECT_GE(strings, 15);
}

TEST(LSystemDerivation, EveryExampleOfTheReferenceDerivesWhatItSays) {
  const std::string page = readFile(fs::path(AXIL_TEST_DIR) / "../../docs/lsystem.md").value();
  const std::string open = "```lsystem\n";
  int examples = 0;
  for (std::size_t at = page.find(open); at != std::string::npos; at = page.find(open, at + 1)) {
    const std::size_t begin = at + open.size();
    const std::string text = page.substr(begin, page.find("```", begin) - begin);
    const std::string mark = "// expect: ";
    ASSERT_TRUE(text.starts_with(mark)) << text;
    std::string expected = text.substr(mark.size(), text.find('\n') - mark.size());
    std::erase(expected, ' ');
    const Parsed parsed = parseLSystem(text);
    ASSERT_TRUE(parsed.ok()) << text;
    EXPECT_TRUE(checkLSystem(parsed.grammar).empty()) << text;
    const auto derived = deriveLSystem(parsed.grammar);
    ASSERT_TRUE(derived) << derived.error().message;
    EXPECT_EQ(toLSystemText(derived->string), expected) << text;
    ++examples;
  }
  EXPECT_GE(examples, 6);
}

std::string expectedText(const fs::path& path) {
  std::string text = readFile(path).value();
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

/// Only the reference program's own rounding decides these.
const std::map<std::string, bool> kSingle{{"math_single_precision", true}, {"math_single_precision_compare", true}};

class Model {
 public:
  explicit Model(const fs::path& path) : path_(path), grammar_(grammarOf(path)), facts_(json::parse(readFile(fs::path(path).replace_extension(".json")).value())) {}

  void check() {
    if (facts_.contains("letter_counts")) return counts();
    compare(std::nullopt, path_.stem().string() + ".expected");
    if (facts_.contains("runs"))
      for (const json& run : facts_["runs"]) compare(run["steps"].get<std::int64_t>(), run["expected"].get<std::string>());
    if (facts_.contains("homomorphism_expected")) image(facts_["homomorphism_expected"].get<std::string>());
  }

 private:
  Result<Derivation> derived(std::optional<std::int64_t> steps, std::uint64_t seed = 1) {
    DeriveLSystemOptions options;
    options.derive.seed = seed;
    options.derive.steps = steps;
    options.derive.singlePrecision = kSingle.contains(path_.stem().string());
    return deriveLSystem(grammar_, options);
  }

  void compare(std::optional<std::int64_t> steps, const std::string& file) {
    const auto result = derived(steps);
    ASSERT_TRUE(result) << path_.filename() << ": " << result.error().message << (result.error().details.empty() ? "" : "\n" + result.error().details[0]);
    expectText(toLSystemText(result->string), file);
  }

  void image(const std::string& file) {
    const auto result = derived(std::nullopt);
    ASSERT_TRUE(result) << path_.filename() << ": " << result.error().message;
    const auto drawn = imageOf(*result);
    ASSERT_TRUE(drawn) << path_.filename() << ": " << drawn.error().message;
    expectText(toLSystemText(drawn->string), file);
  }

  void expectText(const std::string& ours, const std::string& file) {
    const double tolerance = facts_.value("tolerance", 0.0);
    EXPECT_EQ(test::difference(ours, expectedText(path_.parent_path() / file), tolerance), "") << file;
  }

  /// What one derivation of a stochastic model counts must lie where those with many seeds lie: within five of their standard
  /// deviations of their mean. Early draws weigh much, so the spread is measured, not computed.
  void counts() {
    constexpr std::uint64_t seeds = 60;
    std::map<std::string, std::vector<double>> ours;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      const auto result = derived(std::nullopt, seed);
      ASSERT_TRUE(result) << path_.filename() << ": " << result.error().message;
      for (const auto& [letter, count] : letterCounts(result->string)) {
        ours[letter].resize(seed - 1);
        ours[letter].push_back(static_cast<double>(count));
      }
    }
    for (auto& [letter, counts] : ours) {
      EXPECT_TRUE(facts_["letter_counts"].contains(letter)) << path_.filename() << " " << letter;
      counts.resize(seeds);
      double mean = 0, square = 0;
      for (const double count : counts) mean += count / seeds;
      for (const double count : counts) square += (count - mean) * (count - mean) / seeds;
      const double theirs = facts_["letter_counts"].value(letter, 0.0);
      EXPECT_NEAR(mean, theirs, 5 * std::sqrt(square) + 1e-9) << path_.filename() << " " << letter;
    }
    for (const auto& [letter, count] : facts_["letter_counts"].items()) EXPECT_TRUE(ours.contains(letter)) << path_.filename() << " " << letter;
  }

  fs::path path_;
  Grammar grammar_;
  json facts_;
};

TEST(LSystemDerivation, EverySharedModelDerivesTheReferenceString) {
  AXIL_SKIP_WITHOUT_SHARED("data/lsystems/models");
  int models = 0;
  for (const fs::path& path : lFilesIn(test::sharedPath("data/lsystems/models"))) {
    Model(path).check();
    ++models;
  }
  EXPECT_GE(models, 113);
}

}  // namespace
}  // namespace axil::simeco
