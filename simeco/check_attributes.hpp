#pragma once
/// \file
/// The layers of the SimEco checks, second: attributes and their values. Internal to `check`.

#include "simeco/check_expressions.hpp"

#include <array>

namespace axil::simeco::checking {

class AttributeCheck : protected ExpressionCheck {
 protected:
  explicit AttributeCheck(const Grammar& grammar) : ExpressionCheck(grammar) {
    for (const AttributeWord& word : attributeWords()) attributeNames_.push_back(word.name);
    for (const Expr& expr : grammar.expressions)
      if (const auto* name = std::get_if<Name>(&expr.node)) usedNames_.insert(name->name);
  }

  // ---- attributes ----

  void attributes(const std::vector<Attribute>& list, Place place) {
    std::unordered_set<std::string_view> names;
    for (const Attribute& a : list) {
      if (!names.insert(a.name).second && a.name != "Obstacle") report_.error(a.where, "'" + a.name + "' is given a second time in this block", "keep one of them");
      attribute(a, place);
    }
  }
  void attribute(const Attribute& a, Place place) {
    expression(a.value, {});
    const auto words = attributeWords();
    const auto word = std::find_if(words.begin(), words.end(), [&](const AttributeWord& w) { return w.name == a.name; });
    if (word == words.end()) return unknownAttribute(a, place);
    if (word->since11) since11("attributes such as '" + a.name + "'", a.where);
    if (!word->warning.empty()) report_.warning(a.where, "'" + a.name + "' is read, but " + std::string(word->warning));
    if ((word->places & place) == 0)
      report_.warning(a.where, "'" + a.name + "' has no effect here", "it belongs into " + placesOf(word->places));
    value(a, word->kind);
  }
  void unknownAttribute(const Attribute& a, Place place) {
    if (usedNames_.contains(a.name)) return;  // the author's own name for a number
    const std::string hint = didYouMean(a.name, attributeNames_);
    if (!hint.empty()) return report_.error(a.where, "unknown attribute '" + a.name + "'", hint);
    if (place == InOrgan) report_.warning(a.where, "unknown attribute '" + a.name + "': it is kept and has no effect");
  }
  static std::string placesOf(std::uint8_t places) {
    std::string text;
    const auto add = [&](Place place, const char* words) {
      if ((places & place) == 0) return;
      text += (text.empty() ? "" : " or ") + std::string(words);
    };
    add(InEcosystem, "the EcoSystem");
    add(InPlant, "a Plant");
    add(InOrgan, "an organ or its Stage");
    return text;
  }
  void value(const Attribute& a, ValueKind kind) {
    const Expr& expr = grammar_.at(a.value);
    const auto* call = std::get_if<Call>(&expr.node);
    const auto wants = [&](const std::string& what) { report_.error(expr.where, "'" + a.name + "' is " + what); };
    const auto wantsCall = [&](std::string_view function, const std::string& what) {
      if (!call || call->function != function) wants(what);
    };
    switch (kind) {
      case ValueKind::Words:
        if (!std::holds_alternative<Text>(expr.node)) wants("a text in quotes, for example \"leaf.i\"");
        return;
      case ValueKind::Vector:
        return wantsCall("vector", "a vector(x, y, z)");
      case ValueKind::Colour:
        wantsCall("RGBA", "a colour RGBA(red, green, blue, alpha)");
        return shares(a, call);
      case ValueKind::Body:
        if (!call || (call->function != "sphere" && call->function != "box")) wants("a sphere(x, y, z, radius) or a box(x, y, z, x, y, z)");
        return;
      case ValueKind::Material:
        return wantsCall("MTRL", "a material MTRL(...) of six numbers");
      case ValueKind::Number:
      case ValueKind::NotNegative:
      case ValueKind::Positive:
        return number(a, kind);
    }
  }
  /// The parts of a colour go from 0 to 1.
  void shares(const Attribute& a, const Call* call) {
    if (call == nullptr || call->function != "RGBA") return;
    for (const ExprId id : call->arguments)
      if (const Number* part = numberIn(grammar_, id); part != nullptr && part->value > 1)
        return report_.warning(grammar_.at(id).where, "the parts of '" + a.name + "' go from 0 to 1", part->value <= 255 ? "divide by 255" : "");
  }
  void number(const Attribute& a, ValueKind kind) {
    const Expr& expr = grammar_.at(a.value);
    const auto* call = std::get_if<Call>(&expr.node);
    const bool isThing = call && (call->function == "vector" || call->function == "RGBA" || call->function == "MTRL" || call->function == "sphere" || call->function == "box");
    if (isThing || std::holds_alternative<Text>(expr.node)) return report_.error(expr.where, "'" + a.name + "' is a number");
    const auto known = foldedAlone(grammar_, a.value);
    if (!known) return;
    if (kind == ValueKind::Positive && !(*known > 0)) report_.error(expr.where, "'" + a.name + "' must be above 0");
    if (kind == ValueKind::NotNegative && !(*known >= 0)) report_.error(expr.where, "'" + a.name + "' must not be negative");
  }

  std::vector<std::string_view> attributeNames_;
  std::unordered_set<std::string_view> usedNames_;
};

}  // namespace axil::simeco::checking
