#pragma once
/// \file
/// Facts about a plant in the language of the window: the vocabulary's own words for organs and values.

#include "keywords/types.hpp"
#include "ui/texts.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace axil::ui {

/// What a fact can be about: the organ and the property, "leaf" and "arrangement".
struct FactKind {
  std::string organ;
  std::string property;
  bool isMeasured = false;  ///< its value is a size with a unit, not a word
  friend bool operator==(const FactKind&, const FactKind&) = default;
};

/// What a person can state without the text saying it, in the order of the vocabulary; sizes last.
[[nodiscard]] const std::vector<FactKind>& factKinds();

/// The values that facts of this kind can have, by their names in the vocabulary; empty for a size or an unknown kind.
[[nodiscard]] std::vector<std::string> valuesOf(std::string_view organ, std::string_view property);

/// A value, organ or property as a person reads it; what the vocabulary does not have stays as it is.
[[nodiscard]] std::string valueWord(const keywords::Trait& trait, Language language);
[[nodiscard]] std::string valueWord(std::string_view organ, std::string_view property, const std::string& value, Language language);
[[nodiscard]] std::string organWord(const std::string& organ, Language language);

}  // namespace axil::ui
