#include "app/commands.hpp"
#include "app/terminal.hpp"
#include "base/files.hpp"
#include "base/text.hpp"
#include "simeco/simeco.hpp"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <filesystem>
#include <iostream>
#include <iterator>

namespace axil::app {

namespace {

constexpr std::uintmax_t kMaximumTextBytes = 100'000'000;

struct FmtCommand {
  std::vector<std::string> grammars;
  bool check = false;
  std::string language;  ///< of standard input
};

/// The error with the name of the file in front.
Failure about(const std::string& file, Error error) {
  error.message = file + ": " + error.message;
  for (std::string& detail : error.details)
    if (detail.starts_with("text:")) detail.replace(0, 4, file);
  return fail(std::move(error));
}

simeco::Language languageOf(const FmtCommand& command, const std::string& text) {
  if (command.language == "simeco") return simeco::Language::SimEco;
  if (command.language == "lsystem") return simeco::Language::LSystem;
  return text.find("EcoSystem") != std::string::npos ? simeco::Language::SimEco : simeco::Language::LSystem;
}

Result<std::string> laidOut(const std::string& file, const std::string& bytes, simeco::Language language) {
  const auto text = simeco::decodeGrammarText(bytes, language);
  if (!text) return about(file, text.error());
  simeco::LSystemOptions options;
  if (file != "standard input") options.include = simeco::includesBeside(file);
  auto result = simeco::formatted(*text, language, options);
  if (!result) return about(file, result.error());
  return result;
}

int formatInput(const FmtCommand& command) {
  const std::string bytes{std::istreambuf_iterator<char>(std::cin), std::istreambuf_iterator<char>()};
  const auto text = laidOut("standard input", bytes, languageOf(command, bytes));
  if (!text) return report(text.error());
  return command.check ? (*text == bytes ? 0 : 1) : print(*text);
}

/// Whether the file is in the language's layout now; says which ones were not.
Result<bool> formatFile(const FmtCommand& command, const std::string& path) {
  const auto bytes = readFile(path, kMaximumTextBytes);
  if (!bytes) return bytes.failure();
  const auto text = laidOut(path, *bytes, simeco::languageOfFile(path));
  if (!text) return text.failure();
  if (*text == *bytes) return true;
  if (command.check) {
    std::printf("%s\n", path.c_str());
    return false;
  }
  // The file that a link names is laid out, and who may read it stays.
  std::error_code unreadable;
  const auto place = std::filesystem::weakly_canonical(path);
  const auto mode = std::filesystem::status(place, unreadable).permissions();
  if (auto written = writeFile(place, *text); !written) return written.failure();
  if (!unreadable) std::filesystem::permissions(place, mode, unreadable);
  return true;
}

int run(const FmtCommand& command) {
  if (command.grammars.size() == 1 && command.grammars.front() == "-") return formatInput(command);
  int status = 0;
  for (const std::string& path : command.grammars) {
    const auto good = formatFile(command, path);
    if (!good) status = report(good.error());
    else if (!*good) status = 1;
  }
  return status;
}

}  // namespace

void addFmt(CLI::App& sub, int& status) {
  auto& command = onCall<FmtCommand>(sub, status, run);
  addExamples(sub, "  axil fmt plant.simeco                # lays the file out in place; comments stay\n"
                   "  axil fmt --check *.simeco *.l        # names the files that would change; status 1 when there are any\n"
                   "  axil fmt - < plant.l > tidy.l");
  sub.add_option("GRAMMAR", command.grammars, ".simeco or .l files; - reads standard input and prints")->required();
  sub.add_flag("--check", command.check, "Write nothing; status 1 and the names of the files that would change");
  sub.add_option("--language", command.language, "Of standard input: simeco or lsystem; by default what it looks like")->check(CLI::IsMember({"simeco", "lsystem"}));
}

}  // namespace axil::app
