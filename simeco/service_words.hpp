#pragma once
/// \file
/// What an editor says about the words of the two languages, in a few words each. Internal; docs/simeco.md and docs/lsystem.md
/// are the references.

#include <span>
#include <string_view>

#include "simeco/language_service.hpp"

namespace axil::simeco {

struct WordNote {
  std::string_view word;
  CompletionKind kind{};
  std::string_view form;  ///< how it is written, when that is more than the word
  std::string_view text;
};
[[nodiscard]] std::span<const WordNote> wordNotes(Language language);
/// Null when nothing is known of `word` as that kind.
[[nodiscard]] const WordNote* wordNote(Language language, CompletionKind kind, std::string_view word);

}  // namespace axil::simeco
