#include "ui/texts.hpp"

#include "base/files.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>

namespace axil::ui {
namespace {

TEST(Texts, EveryKeyThatTheWindowUsesHasWords) {
  const auto texts = Texts::load();
  ASSERT_TRUE(texts) << texts.error().message;
  // Keys as they stand in the sources: t("..."), button(panel, "..."), heading(panel, "..."), and rows of tables of keys.
  const std::regex use(R"re((?:\bt\(|(?:button|heading|choice|optionalRow|angleRow|lengthRow)\(panel, )"([a-z_]+)")re");
  std::set<std::string> used;
  for (const auto& entry : std::filesystem::directory_iterator(AXIL_UI_DIR)) {
    if (entry.path().extension() != ".cpp") continue;
    const auto source = readFile(entry.path());
    ASSERT_TRUE(source);
    for (std::sregex_iterator it(source->begin(), source->end(), use), end; it != end; ++it) used.insert((*it)[1]);
  }
  EXPECT_GT(used.size(), 60u);
  for (const std::string& key : used) EXPECT_TRUE(texts->has(key)) << key;
}

TEST(Texts, EveryLanguageSaysSomethingAndKeepsThePlacesToFillIn) {
  const auto texts = Texts::load();
  ASSERT_TRUE(texts);
  const std::string english = (*texts)("click_branch", Language::English);
  for (const char* place : {"{node}", "{stem}"})
    for (const Language language : {Language::English, Language::TraditionalChinese, Language::SimplifiedChinese})
      EXPECT_NE(std::string((*texts)("click_branch", language)).find(place), std::string::npos) << place;
  EXPECT_EQ(filled(english, {{"stem", "7"}, {"node", "3"}}).find('{'), std::string::npos);
  EXPECT_STREQ((*texts)("no_such_key", Language::English), "no_such_key");
}

}  // namespace
}  // namespace axil::ui
