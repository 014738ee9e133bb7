#pragma once
/// \file
/// An index of what a grammar's text speaks of: every place of every name, module, attribute, macro and label, with what it
/// belongs to. Internal to the language service; made from the grammar, so a broken text has what could be read of it.

#include "simeco/language_service.hpp"

namespace axil::simeco {

enum class SubjectKind { Module, Name, Attribute, Macro, Function, Label, Keyword };

/// One place that speaks of something.
struct Mention {
  SourceSpan where;             ///< the word itself
  SubjectKind kind{};
  std::string key;              ///< the word; of a module its letter and number of arguments, "A/2"
  int scope = 0;                ///< names of different scopes are different names; 0 where that does not count
  bool defines = false;         ///< binds, assigns, declares it, or rewrites it
  std::optional<double> number = {};  ///< of a SimEco organ its literal stage
  SourceSpan whole;             ///< what it is part of: the rule, the attribute's line
};

/// In text order.
[[nodiscard]] std::vector<Mention> mentionsIn(const Analysis& analysis);

/// The mention whose word holds byte `offset`, or ends there; null when there is none.
[[nodiscard]] const Mention* mentionAt(const std::vector<Mention>& mentions, std::size_t offset);

}  // namespace axil::simeco
