#include "app/commands.hpp"
#include "app/hand_over.hpp"
#include "app/terminal.hpp"
#include "base/files.hpp"
#include "keywords/keywords.hpp"

#include <CLI/CLI.hpp>

#include <fstream>
#include <iostream>
#include <string>
#include <utility>

namespace axil::app {

namespace {

struct KeywordsCommand {
  std::string file;  ///< "-": stdin
  bool json = false;
  bool vocabulary = false;
  std::string gallery;  ///< a picture of all shapes goes here; empty: none
};

/// A file's or standard input's bytes, some at a time.
class Bytes {
 public:
  explicit Bytes(const std::string& file) {
    if (file != "-") opened_.open(file, std::ios::binary);
  }
  [[nodiscard]] std::string next(std::size_t most) {
    std::istream& in = opened_.is_open() ? static_cast<std::istream&>(opened_) : std::cin;
    std::string bytes(most, '\0');
    in.read(bytes.data(), static_cast<std::streamsize>(most));
    bytes.resize(static_cast<std::size_t>(in.gcount()));
    return bytes;
  }

 private:
  std::ifstream opened_;
};

/// Drawing needs heavy libraries: where this program does not have them, the one that has goes on.
int gallery(std::string out) {
  if (drawShapeGallery != nullptr) return drawShapeGallery(out);
  std::string words[] = {"axil", "keywords", "--gallery"};
  char* arguments[] = {words[0].data(), words[1].data(), words[2].data(), out.data(), nullptr};
  return handOver("axil-draw", arguments);
}

int refuse(const KeywordsCommand& command, const Error& error) {
  return report({error.code, (command.file == "-" ? "standard input" : command.file) + ": " + error.message, error.details});
}

int readWhole(const KeywordsCommand& command, const std::string& text) {
  const auto reading = keywords::readDescription(text);
  if (!reading) return refuse(command, reading.error());
  const keywords::Presets presets = keywords::presetsOf(reading->traits);
  return print(command.json ? keywords::readingJson(*reading, presets) : keywords::readingText(*reading, presets));
}

/// A text of many plants, printed as it is read: `start` and what `rest` still has.
int readLong(const KeywordsCommand& command, std::string start, Bytes& rest) {
  constexpr std::size_t atOnce = 1'000'000;
  keywords::PieceReport lines(command.json ? keywords::PieceReport::Form::Json : keywords::PieceReport::Form::Text);
  bool begun = false;
  int status = 0;
  const auto next = [&] { return start.empty() ? rest.next(atOnce) : std::exchange(start, {}); };
  const auto pieces = keywords::readInPieces(next, [&](const keywords::Reading& reading) {
    if (!begun) status = print(lines.begin());
    begun = true;
    if (status == 0) status = print(lines.piece(reading));
  });
  if (begun && status == 0) status = print(lines.end());
  return pieces ? status : refuse(command, pieces.error());
}

int run(const KeywordsCommand& command) {
  if (!command.gallery.empty()) return gallery(command.gallery);
  if (command.vocabulary) return print(keywords::vocabularyText());
  if (command.file.empty()) {
    std::cerr << "axil: error: FILE is required, or --gallery OUT.png, or --vocabulary; `axil keywords --help` says how it is called\n";
    return 2;
  }
  Bytes bytes(command.file);
  if (command.file == "-") {
    const std::string start = bytes.next(keywords::descriptionLimitBytes + 1);
    return start.size() > keywords::descriptionLimitBytes ? readLong(command, start, bytes) : readWhole(command, start);
  }
  const auto text = readFile(command.file, keywords::descriptionLimitBytes);
  if (text) return readWhole(command, *text);
  return text.error().code == ErrorCode::LimitReached ? readLong(command, bytes.next(1'000'000), bytes) : report(text.error());
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
