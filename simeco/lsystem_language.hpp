#pragma once
/// \file
/// The classic L-system language of `.l` files (docs/lsystem.md): text to Grammar. A file is one plant; its first L-system is
/// `plants[0].rules`, the others, which `?(label, scale)` enters, are `plants[0].subRules`. Every printable character of a
/// string is a letter of its own: `@v` is `@` and then `v`.
///
/// Places in the grammar and in diagnostics are places of the text as it was written, before macros; what comes out of an
/// included file stands at its `#include`, and the message names the file and the line there.

#include "base/result.hpp"
#include "simeco/language.hpp"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace axil::simeco {

/// The text of an included file, or why there is none.
using IncludeReader = std::function<Result<std::string>(const std::string& name)>;

struct LSystemOptions {
  IncludeReader include = {};                  ///< none: `#include` is an error
  std::size_t macroTextLimit = 16'000'000;  ///< bytes that macros and includes may add to the text
};

/// Parses an L-system file (ASCII outside comments and quoted texts). Syntax only; `checkLSystem` finds the rest.
[[nodiscard]] Parsed parseLSystem(std::string_view text, const LSystemOptions& options = {});

/// What is wrong with an L-system that parsed: arrays nobody declared, wrong numbers of arguments or indices, brackets that
/// a rule leaves open; warnings for names nobody assigned, rules that can never fire, weights without a seed.
[[nodiscard]] std::vector<Diagnostic> checkLSystem(const Grammar& grammar);

/// The grammar in the classic syntax, macros expanded and includes pasted; `parseLSystem(printLSystem(g)).grammar == g`.
[[nodiscard]] std::string printLSystem(const Grammar& grammar);

/// One expression or module in the classic syntax.
[[nodiscard]] std::string printLSystemExpression(const Grammar& grammar, ExprId id);
[[nodiscard]] std::string printLSystemModule(const Grammar& grammar, const Module& module);

/// Reads includes from the folder of the file that asks for them; names that leave that folder are refused.
[[nodiscard]] IncludeReader includesBeside(const std::filesystem::path& file);

}  // namespace axil::simeco
