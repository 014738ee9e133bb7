#include "app/commands.hpp"
#include "app/terminal.hpp"
#include "base/files.hpp"
#include "keywords/keywords.hpp"

#include <CLI/CLI.hpp>

#include <iostream>
#include <string>

namespace axil::app {

namespace {

struct KeywordsCommand {
  std::string file;  ///< "-": stdin
  bool json = false;
};

constexpr std::uintmax_t kMaximumTextBytes = 100'000'000;

Result<std::string> textOf(const std::string& file) {
  if (file != "-") return readFile(file, kMaximumTextBytes);
  std::string text;
  for (char c; text.size() <= kMaximumTextBytes && std::cin.get(c);) text.push_back(c);
  if (text.size() > kMaximumTextBytes) return fail(ErrorCode::LimitReached, "the description is longer than the limit of 100,000,000 bytes");
  return text;
}

int run(const KeywordsCommand& command) {
  const auto bytes = textOf(command.file);
  if (!bytes) return report(bytes.error());
  const auto traits = keywords::readTraits(*bytes);
  if (!traits) return report({traits.error().code, (command.file == "-" ? "standard input" : command.file) + ": " + traits.error().message, traits.error().details});
  return print(command.json ? keywords::traitsJson(*traits, keywords::presetsOf(*traits)) : keywords::traitsText(*traits, keywords::presetsOf(*traits)));
}

}  // namespace

void addKeywords(CLI::App& sub, int& status) {
  auto& command = onCall<KeywordsCommand>(sub, status, run);
  addExamples(sub, "  axil keywords description.txt\n  echo 'Shrub; leaves opposite, ovate, 3-8 cm long' | axil keywords - --json");
  sub.add_option("FILE", command.file, "A description in English or Chinese, UTF-8; - reads standard input")->required();
  sub.add_flag("--json", command.json, "Print JSON: every trait with its words and their place, and the presets they set");
}

}  // namespace axil::app
