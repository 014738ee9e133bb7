#pragma once
/// \file
/// Replay: a saved session, line by line. A line is a step (document/command_text.hpp), or `undo` or `redo` with or without a number of
/// steps; empty lines and lines that begin with # do not count. Tests, samples, bug reports and the journal are such lines.

#include "document/history.hpp"

#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace axil::document {

struct Undo {
  std::size_t steps = 1;
  friend bool operator==(const Undo&, const Undo&) = default;
};
struct Redo {
  std::size_t steps = 1;
  friend bool operator==(const Redo&, const Redo&) = default;
};
/// What a line of a session does.
using Action = std::variant<Step, Undo, Redo>;

/// Fails as parseStep does.
[[nodiscard]] Result<Action> parseAction(std::string_view line);
[[nodiscard]] std::string printAction(const Action& action);
[[nodiscard]] Result<History::Ran> perform(History& history, const Action& action);

/// The lines of a text that count, and the sentence for what went wrong in one: `line 12 (undo): there is nothing to undo`.
struct NumberedLine {
  int number = 0;  ///< from 1, of all lines
  std::string_view text;
};
[[nodiscard]] std::vector<NumberedLine> linesThatCount(std::string_view lines);
[[nodiscard]] std::string inLine(const NumberedLine& line, const Error& error);

/// The history after all lines, from `project` on. Fails at the first line that cannot be read or done: `line 12: ...`.
[[nodiscard]] Result<History> replay(const Project& project, std::string_view lines);

/// The same, going on past lines that cannot be done; each is named in `faults`.
struct Replayed {
  History history;
  std::vector<std::string> faults;
};
[[nodiscard]] Replayed replayWhatApplies(const Project& project, std::string_view lines);

}  // namespace axil::document
