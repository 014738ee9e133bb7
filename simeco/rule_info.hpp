#pragma once
/// \file
/// RuleInfo: which rule of a text made something. What a derivation or a plant is made of knows its rule by number; here the number
/// leads to the rule's kind, place in the text and wording, in O(1) and without the text.

#include "base/source.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace axil::simeco {

/// Which of an L-system's rules a rule is.
enum class RuleKind : std::uint8_t { Production, Decomposition, Homomorphism, Interaction };

struct RuleInfo {
  RuleKind kind = RuleKind::Production;
  std::size_t plant = 0;
  std::size_t system = 0;        ///< 0: the plant's own L-system, else the sub-L-system of that number, counted from 1
  std::size_t number = 0;        ///< in text order among the rules of its kind
  SourceSpan where;
  std::string name;              ///< "S(4) -> ... (plant.simeco:12)"
};

/// Rules by number, shared by all that they made. Things that are made alike are equal whatever their rules are called.
class RuleList {
 public:
  RuleList() = default;
  explicit RuleList(std::vector<RuleInfo> rules) : rules_(std::make_shared<const std::vector<RuleInfo>>(std::move(rules))) {}

  [[nodiscard]] std::size_t size() const { return rules_ ? rules_->size() : 0; }
  /// Null for what no rule made (-1: the axiom).
  [[nodiscard]] const RuleInfo* find(std::int32_t rule) const {
    return rule >= 0 && static_cast<std::size_t>(rule) < size() ? &(*rules_)[static_cast<std::size_t>(rule)] : nullptr;
  }
  friend bool operator==(const RuleList&, const RuleList&) { return true; }

 private:
  std::shared_ptr<const std::vector<RuleInfo>> rules_;
};

}  // namespace axil::simeco
