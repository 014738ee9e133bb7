#include "ui/texts.hpp"

#include "base/files.hpp"
#include "simeco/simeco.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <regex>
#include <set>
#include <sstream>

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
  EXPECT_EQ(filled("{n} {n=1:stem|stems}", {{"n", "1"}}), "1 stem");
  EXPECT_EQ(filled("{n} {n=1:stem|stems}", {{"n", "21"}}), "21 stems");
  EXPECT_STREQ((*texts)("no_such_key", Language::English), "no_such_key");
}

TEST(Texts, MessagesOfOtherRoomsAreSaidInTheLanguageOfTheWindow) {
  const Texts texts = Texts::load().value();
  const std::string message = "the clicks do not make a plant: node 12 is clicked in one view only (front); click it in another too (and 2 more)";
  EXPECT_EQ(texts.translated(message, Language::English), message);
  const std::string said = texts.translated(message, Language::SimplifiedChinese);
  for (const char* part : {"12", "front", "另有 2 项", "节点"}) EXPECT_NE(said.find(part), std::string::npos) << said;
  EXPECT_EQ(said.find("click"), std::string::npos) << said;
  EXPECT_EQ(texts.translated("no row says this", Language::TraditionalChinese), "no row says this");
}

/// Two English words in a row outside quotes and samples of code, which no translation has.
bool speaksEnglish(const std::string& said) {
  static const std::regex quoted(R"('[^']*'|"[^"]*"|“[^”' ]*”|「[^」' ]*」|\{[^}]*\})"), words(R"(\b[a-z]{2,} [a-z]{2,}\b)");
  return std::regex_search(std::regex_replace(said, quoted, ""), words);
}

TEST(Texts, WhatIsWrongWithAGrammarIsSaidInTheLanguageOfTheWindow) {
  const Texts texts = Texts::load().value();
  std::size_t told = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(AXIL_UI_DIR).parent_path() / "tests/simeco/language")) {
    const simeco::Parsed parsed = simeco::parseSimeco(readFile(entry.path()).value());
    std::vector<Diagnostic> all = parsed.diagnostics;
    for (const Diagnostic& d : simeco::check(parsed.grammar)) all.push_back(d);
    for (const Diagnostic& d : all)
      for (const std::string& english : {d.message, d.hint}) {
        if (english.empty()) continue;
        ++told;
        const std::string said = texts.translated(english, Language::TraditionalChinese);
        EXPECT_FALSE(speaksEnglish(said)) << said << "\n  from " << english;
      }
  }
  EXPECT_GT(told, 150u);
}

TEST(Texts, NamesInQuotesStayAsTheyWereWritten) {
  const Texts texts = Texts::load().value();
  const std::string said = texts.translated("unknown name 'value'", Language::TraditionalChinese);
  EXPECT_NE(said.find("value"), std::string::npos) << said;
  EXPECT_FALSE(speaksEnglish(texts.translated("'=' is expected after 'Stem', but here 'Grow' stands", Language::SimplifiedChinese)));
}

/// All sources of the rooms whose messages the table translates, with adjoining literals as one.
std::string sourcesOfRooms() {
  std::string all;
  for (const char* room : {"base", "simeco", "document", "skeleton3d", "quantify", "emit", "render", "ui"})
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(AXIL_UI_DIR).parent_path() / room))
      if (entry.path().extension() == ".cpp" || entry.path().extension() == ".hpp") all += readFile(entry.path()).value();
  all = std::regex_replace(all, std::regex("\"\\s*\n\\s*\""), "");
  return std::regex_replace(all, std::regex(R"(\\")"), "\"");
}

/// The last words of each piece of a message that never changes, of the longest piece first; ids are written by functions of their own ("node 3").
std::vector<std::string> lastWords(const std::string& message) {
  static const std::regex changing(R"(\{\d\}|\b(node|stem) | or )"), words(R"((\S+ ){0,3}\S+$)");
  std::vector<std::string> pieces;
  for (std::sregex_token_iterator it(message.begin(), message.end(), changing, -1), end; it != end; ++it) {
    const std::string piece = it->str();
    const std::size_t from = piece.find_first_not_of(" '():,;"), to = piece.find_last_not_of(" '():,;");
    std::smatch last;
    const std::string trimmed = from == std::string::npos ? std::string() : piece.substr(from, to + 1 - from);
    if (std::regex_search(trimmed, last, words)) pieces.push_back(last.str());
  }
  std::stable_sort(pieces.begin(), pieces.end(), [](const std::string& a, const std::string& b) { return a.size() > b.size(); });
  pieces.resize(std::min<std::size_t>(pieces.size(), 2));
  return pieces;
}

TEST(Texts, EveryMessageOfTheTableIsOneThatARoomCanSay) {
  std::string sources = sourcesOfRooms();
  for (const int error : {ENOSPC, EACCES, EROFS, ENOENT}) sources += std::strerror(error);
  std::istringstream table(readFile(std::filesystem::path(AXIL_UI_DIR) / "data" / "messages.tsv").value());
  std::size_t messages = 0;
  for (std::string line; std::getline(table, line);) {
    if (line.empty() || line[0] == '#' || line.starts_with("en\t")) continue;
    const std::string message = line.substr(0, line.find('\t'));
    const std::vector<std::string> pieces = lastWords(message);
    ++messages;
    EXPECT_TRUE(std::any_of(pieces.begin(), pieces.end(), [&](const std::string& piece) { return sources.find(piece) != std::string::npos; })) << "no room says: " << message;
  }
  EXPECT_GT(messages, 300u);
}

}  // namespace
}  // namespace axil::ui
