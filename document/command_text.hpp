#pragma once
/// \file
/// Commands as lines of text, and back: `add_click 12 front 512 300`. `parseCommand(print(c)) == c` for every command whose numbers are
/// finite. The same lines are the journal, saved sessions, what the command palette takes and what bug reports hold.
///
/// A line is the command's name and its arguments, separated by blanks. A text with blanks, quotes, semicolons or equals signs is
/// "quoted", with \" \\ \n \t \r and \xNN inside. What may be left out is given by name: `add_leaves 2 nodes=4 angle=55 shape=ovate`;
/// angles are in degrees, or in radians as `0.96rad`, which is printed where no number of degrees is exactly the same. A step of several
/// commands is one line with semicolons: `add_node 12 front 512 300 ; append_node 2 12`.

#include "document/command.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace axil::document {

/// What an argument is, so that a palette can offer what fits.
enum class ArgumentKind { Text, Number, Whole, View, Node, NewNode, Stem, NewStem, Photo, Model, LeavesNumber, Option };

struct CommandArgument {
  std::string name;  ///< "node", "x"; an option's name stands before its equals sign
  ArgumentKind kind = ArgumentKind::Text;
  enum class Count { One, OneOrMore, ZeroOrOne } count = Count::One;
};

/// One row of the table that printing, parsing and the palette share.
struct CommandInfo {
  std::string name;
  std::vector<CommandArgument> arguments;
  std::string help;  ///< one line
};

/// Every command, in the order of the variant: commandTable()[command.index()].
[[nodiscard]] const std::vector<CommandInfo>& commandTable();
/// `add_click NODE VIEW X Y`.
[[nodiscard]] std::string usageOf(const CommandInfo& info);

[[nodiscard]] std::string print(const Command& command);
[[nodiscard]] std::string print(std::span<const Command> step);

/// Fails with BadInput: what is wrong with which word, and what the command takes.
[[nodiscard]] Result<Command> parseCommand(std::string_view line);
[[nodiscard]] Result<Step> parseStep(std::string_view line);

}  // namespace axil::document
