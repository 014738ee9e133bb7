#pragma once
/// \file
/// Text to Grammar and back, and what is wrong with it. Parsing never stops at the first error: a file's errors come all
/// at once, each with its place and a hint. Nothing here derives.

#include "base/result.hpp"
#include "base/source.hpp"
#include "simeco/grammar.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace axil::simeco {

/// What a text says, as far as it can be understood, and what is wrong with it.
struct Parsed {
  Grammar grammar;
  std::vector<Diagnostic> diagnostics;  ///< in text order
  [[nodiscard]] bool ok() const { return !hasErrors(diagnostics); }
};

/// Parses SimEco 1.0 or 1.1 (UTF-8). Syntax only; `check` finds the rest.
[[nodiscard]] Parsed parseSimeco(std::string_view text);

/// What is wrong with a grammar that parsed: unknown modules and stages, wrong numbers of arguments, unbalanced brackets,
/// names nobody bound, division by a literal zero, 1.1 features in a 1.0 file; warnings for rules that can never fire.
[[nodiscard]] std::vector<Diagnostic> check(const Grammar& grammar);

/// Adds what `check` finds to what parsing found, in text order: not what a broken rule only says once more.
void addChecked(Parsed& parsed);

/// The grammar's text, in the thesis' own layout; `parse(print(g)) == g`, and printing what was printed changes no byte.
[[nodiscard]] std::string print(const Grammar& grammar);
/// One expression or module, for messages.
[[nodiscard]] std::string printExpression(const Grammar& grammar, ExprId id);
[[nodiscard]] std::string printModule(const Grammar& grammar, const Module& module);

/// A grammar's text with its name, as a file holds it: decoded to UTF-8, parsed and checked.
struct GrammarFile {
  std::filesystem::path path;
  std::string text;
  Parsed parsed;  ///< diagnostics of both parsing and checking, in text order
};

/// The text in the bytes of a grammar file: UTF-8, UTF-16, Big5; in the classic language, whose old files often have Latin-1
/// comments, those as well. Fails with Unreadable when it is no text.
[[nodiscard]] Result<std::string> decodeGrammarText(std::string_view bytes, Language language);

/// Reads a `.simeco` file (or a `.l` file, in the classic language). Fails when there is no readable text; errors in the
/// text are in `parsed`, not a failure.
[[nodiscard]] Result<GrammarFile> readGrammarFile(const std::filesystem::path& path);
/// The same, but any error in the text is a BadGrammar failure whose details are the printed diagnostics.
[[nodiscard]] Result<Grammar> loadGrammar(const std::filesystem::path& path);

}  // namespace axil::simeco
