#include "app/commands.hpp"
#include "app/hand_over.hpp"
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
  bool vocabulary = false;
  std::string gallery;  ///< a picture of all shapes goes here; empty: none
};

constexpr std::uintmax_t kMaximumTextBytes = keywords::descriptionLimitBytes;

Failure tooLong(const std::string& file) {
  return fail(ErrorCode::LimitReached, file + " has more than " + std::to_string(kMaximumTextBytes / 1'000'000) + " MB, the limit for a description; cut it into parts, for example with `split -C 10M`");
}

Result<std::string> textOf(const std::string& file) {
  if (file != "-") {
    auto text = readFile(file, kMaximumTextBytes);
    return !text && text.error().code == ErrorCode::LimitReached ? Result<std::string>(tooLong(file)) : text;
  }
  std::string text;
  for (char c; text.size() <= kMaximumTextBytes && std::cin.get(c);) text.push_back(c);
  if (text.size() > kMaximumTextBytes) return tooLong("standard input");
  return text;
}

/// Drawing needs heavy libraries: where this program does not have them, the one that has goes on.
int gallery(std::string out) {
  if (drawShapeGallery != nullptr) return drawShapeGallery(out);
  std::string words[] = {"axil", "keywords", "--gallery"};
  char* arguments[] = {words[0].data(), words[1].data(), words[2].data(), out.data(), nullptr};
  return handOver("axil-draw", arguments);
}

int run(const KeywordsCommand& command) {
  if (!command.gallery.empty()) return gallery(command.gallery);
  if (command.vocabulary) return print(keywords::vocabularyText());
  if (command.file.empty()) {
    std::cerr << "axil: error: FILE is required, or --gallery OUT.png, or --vocabulary; `axil keywords --help` says how it is called\n";
    return 2;
  }
  const auto bytes = textOf(command.file);
  if (!bytes) return report(bytes.error());
  const auto reading = keywords::readDescription(*bytes);
  if (!reading) return report({reading.error().code, (command.file == "-" ? "standard input" : command.file) + ": " + reading.error().message, reading.error().details});
  const keywords::Presets presets = keywords::presetsOf(reading->traits);
  return print(command.json ? keywords::readingJson(*reading, presets) : keywords::readingText(*reading, presets));
}

}  // namespace

void addKeywords(CLI::App& sub, int& status) {
  auto& command = onCall<KeywordsCommand>(sub, status, run);
  addExamples(sub, "  axil keywords description.txt\n  echo 'Shrub; leaves opposite, ovate, 3-8 cm long' | axil keywords - --json");
  auto* file = sub.add_option("FILE", command.file, "A description in English or Chinese (UTF-8, UTF-16, Big5 or GB18030); - reads standard input");
  auto* sheet = sub.add_option("--gallery", command.gallery, "Draw a contact sheet of all shapes that words can name into this PNG; no FILE is read");
  sheet->excludes(file);
  sub.add_flag("--vocabulary", command.vocabulary, "Print every concept with its name, id and words in the three scripts, separated by tabs; no FILE is read")->excludes(file)->excludes(sheet);
  sub.add_flag("--json", command.json, "Print JSON: every trait with its words and their place, and the presets they set");
}

}  // namespace axil::app
