#pragma once
/// \file
/// The language service: what an editor asks about a grammar's text, for both languages. All of it is tolerant: a text that is
/// half typed still has its tokens, its symbols and most of its meaning. Places are byte spans of the text as the author sees it.
///
/// Per key stroke: `tokensOf` (one pass over the text, no parse). When typing pauses: `analyse`, which parses and checks once;
/// hover, definition, references and completion then only look up. Nothing here fails; what is not known is empty.

#include "base/result.hpp"
#include "base/source.hpp"
#include "simeco/language.hpp"
#include "simeco/lsystem_language.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace axil::simeco {

// ---- tokens, for colours -----------------------------------------------------------------------------------------------

enum class TokenRole : std::uint8_t {
  Comment,
  Directive,  ///< `#define`
  Macro,      ///< a name that #define made, where it is made and where it is used
  Keyword,    ///< `Stage`, `derivation length:`, `while`
  Attribute,  ///< `GrowRate` in front of its =
  Module,     ///< a letter of the string
  Branch,     ///< [ and ] of a string
  Name,       ///< a parameter or variable
  Function,   ///< a known one
  Number,
  Text,       ///< in quotes; the label of an L-system
  Operator,
  Sign,       ///< what separates the parts of a rule: < > : --> -> |
  Separator,  ///< , ; ( ) { } and the [ ] of arrays
  Unknown,    ///< means nothing here
};

struct ServiceToken {
  SourceSpan span;
  TokenRole role{};
  friend bool operator==(const ServiceToken&, const ServiceToken&) = default;
};

/// All tokens in text order; they do not overlap, and what is between them is blank.
[[nodiscard]] std::vector<ServiceToken> tokensOf(std::string_view text, Language language);

/// The language that a file of this name is written in: `.l` is the classic one.
[[nodiscard]] Language languageOfFile(std::string_view fileName);

// ---- what a text means -------------------------------------------------------------------------------------------------

enum class SymbolKind { Ecosystem, Plant, Organ, Stage, Attribute, System, Axiom, Rule, Macro, Array };

/// An entry of the outline. Rules are called what they rewrite: `A(x, y)`.
struct ServiceSymbol {
  SymbolKind kind{};
  std::string name;
  SourceSpan where;  ///< all of it
  int level = 0;     ///< of nesting, for an outline; a symbol belongs to the last one before it of a lower level
};

/// A text parsed and checked, with an index of its names and modules.
struct Analysis {
  Language language{};
  std::string text;
  Parsed parsed;                       ///< diagnostics of parsing and checking, in text order
  std::vector<ServiceToken> tokens;
  std::vector<ServiceSymbol> symbols;  ///< in text order
};
[[nodiscard]] Analysis analyse(std::string_view text, Language language, const LSystemOptions& options = {});

/// What stands at byte `offset`, in a sentence or two: a module with the rules that rewrite it, a function with its arguments,
/// an attribute with its unit, a macro with its text.
struct Hover {
  SourceSpan where;
  std::string text;
};
[[nodiscard]] std::optional<Hover> hoverAt(const Analysis& analysis, std::size_t offset);

/// Where what stands at `offset` is made: of a module the rules that rewrite it, in text order, and its Stage; of a name the
/// place that binds or assigns it first; of a macro its #define; of an attribute's name its line.
[[nodiscard]] std::vector<SourceSpan> definitionsAt(const Analysis& analysis, std::size_t offset);

/// Every place that speaks of the same thing as `offset` does, that one included, in text order. A rule's own names are only
/// looked for within that rule.
[[nodiscard]] std::vector<SourceSpan> referencesAt(const Analysis& analysis, std::size_t offset);

enum class CompletionKind { Keyword, Attribute, Function, Module, Name, Macro };
struct Completion {
  std::string text;    ///< to stand instead of `replaces`
  std::string detail;  ///< a few words beside it; may be empty
  CompletionKind kind{};
};
struct Completions {
  SourceSpan replaces;              ///< the word that is being typed, up to `offset`
  std::vector<Completion> entries;  ///< those that begin with it, sorted by text
};
[[nodiscard]] Completions completionsAt(const Analysis& analysis, std::size_t offset);

// ---- layout ------------------------------------------------------------------------------------------------------------

/// The text in its language's layout. Comments stay; in the classic language so do macros, includes and line breaks. What is
/// laid out means the same (it is read back and compared), and laying it out again changes no byte.
/// Fails with BadGrammar when the text has errors (its details are the printed diagnostics): what cannot be read cannot be laid out.
[[nodiscard]] Result<std::string> formatted(std::string_view text, Language language, const LSystemOptions& options = {});

}  // namespace axil::simeco
