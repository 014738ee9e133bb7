#include "document/replay.hpp"

#include "base/overloaded.hpp"
#include "document/command_text.hpp"
#include "document/command_words.hpp"

#include <charconv>
#include <optional>

namespace axil::document {

namespace {

bool counts(std::string_view line) {
  const std::size_t first = line.find_first_not_of(" \t\r");
  return first != std::string_view::npos && line[first] != '#';
}

std::string moveText(const char* word, std::size_t steps) { return steps == 1 ? word : std::string(word) + " " + std::to_string(steps); }

/// How often `undo` or `redo` is done; nothing where the words are no such line.
std::optional<Result<std::size_t>> stepsAfter(const char* word, const std::vector<Word>& words) {
  if (words.empty() || words[0].whole() != word) return std::nullopt;
  if (words.size() == 1) return Result<std::size_t>(1);
  const std::string text = words[1].whole();
  std::size_t steps = 0;
  const bool read = std::from_chars(text.data(), text.data() + text.size(), steps).ptr == text.data() + text.size();
  if (words.size() == 2 && read && steps > 0) return Result<std::size_t>(steps);
  return Result<std::size_t>(fail(ErrorCode::BadInput, std::string(word) + " takes nothing, or a number of steps from 1"));
}

Result<void> performLine(History& history, std::string_view text) {
  const auto action = parseAction(text);
  if (!action) return action.failure();
  const auto done = perform(history, *action);
  return done ? Result<void>() : done.failure();
}

}  // namespace

Result<Action> parseAction(std::string_view line) {
  const auto commands = cutLine(line);
  if (!commands) return commands.failure();
  if (commands->size() == 1) {
    if (const auto steps = stepsAfter("undo", commands->front())) return *steps ? Result<Action>(Undo{**steps}) : steps->failure();
    if (const auto steps = stepsAfter("redo", commands->front())) return *steps ? Result<Action>(Redo{**steps}) : steps->failure();
  }
  auto step = parseStep(line);
  if (!step) return step.failure();
  return Action(std::move(*step));
}

std::string printAction(const Action& action) {
  return std::visit(overloaded{[](const Step& step) { return print(step); }, [](const Undo& undo) { return moveText("undo", undo.steps); },
                               [](const Redo& redo) { return moveText("redo", redo.steps); }},
                    action);
}

Result<History::Ran> perform(History& history, const Action& action) {
  const auto moved = [](const Result<void>& result) { return result ? Result<History::Ran>(History::Ran::Changed) : result.failure(); };
  return std::visit(overloaded{[&](const Step& step) { return history.run(step); }, [&](const Undo& undo) { return moved(history.undo(undo.steps)); },
                               [&](const Redo& redo) { return moved(history.redo(redo.steps)); }},
                    action);
}

std::vector<NumberedLine> linesThatCount(std::string_view text) {
  std::vector<NumberedLine> lines;
  int number = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const NumberedLine line{++number, text.substr(0, end)};
    if (counts(line.text)) lines.push_back(line);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

std::string inLine(const NumberedLine& line, const Error& error) {
  constexpr std::size_t kShown = 120;
  const std::string shown = line.text.size() > kShown ? std::string(line.text.substr(0, kShown)) + ".." : std::string(line.text);
  return "line " + std::to_string(line.number) + " (" + shown + "): " + error.message;
}

Result<History> replay(const Project& project, std::string_view lines) {
  History history(project);
  for (const NumberedLine& line : linesThatCount(lines))
    if (const auto done = performLine(history, line.text); !done) return fail(done.error().code, inLine(line, done.error()));
  return history;
}

Replayed replayWhatApplies(const Project& project, std::string_view lines) {
  Replayed replayed{History(project), {}};
  for (const NumberedLine& line : linesThatCount(lines))
    if (const auto done = performLine(replayed.history, line.text); !done) replayed.faults.push_back(inLine(line, done.error()));
  return replayed;
}

}  // namespace axil::document
