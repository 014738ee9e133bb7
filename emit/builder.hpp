#pragma once
/// \file
/// Short words for building a SimEco Grammar. Private to this room.

#include "base/turning.hpp"
#include "simeco/grammar.hpp"

#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace axil::emit {

/// Adds expressions to one grammar's arena and makes modules and attributes of them.
class Builder {
 public:
  explicit Builder(simeco::Grammar& grammar) : grammar_(grammar) {}

  [[nodiscard]] simeco::ExprId number(double value, int decimals) {
    return grammar_.add(decimals < 0 ? simeco::Number{value, -1} : simeco::fixedNumber(value, decimals));
  }
  /// A number that is already rounded to so many decimals.
  [[nodiscard]] simeco::ExprId printed(double value, int decimals) { return grammar_.add(simeco::Number{value, decimals}); }
  [[nodiscard]] simeco::ExprId whole(int value) { return grammar_.add(simeco::Number{static_cast<double>(value), -1}); }
  [[nodiscard]] simeco::ExprId name(std::string text) { return grammar_.add(simeco::Name{std::move(text)}); }
  [[nodiscard]] simeco::ExprId call(std::string function, std::vector<simeco::ExprId> arguments) {
    return grammar_.add(simeco::Call{std::move(function), std::move(arguments)});
  }
  [[nodiscard]] simeco::ExprId binary(simeco::BinaryOp op, simeco::ExprId left, simeco::ExprId right) {
    return grammar_.add(simeco::Binary{op, left, right});
  }

  [[nodiscard]] simeco::Attribute attribute(std::string attributeName, simeco::ExprId value) { return {std::move(attributeName), value, {}, {}}; }
  [[nodiscard]] simeco::Attribute text(std::string attributeName, std::string value) {
    return attribute(std::move(attributeName), grammar_.add(simeco::Text{std::move(value)}));
  }
  [[nodiscard]] simeco::Attribute vector(std::string attributeName, const glm::dvec3& v, int decimals) {
    return attribute(std::move(attributeName), call("vector", {number(v.x, decimals), number(v.y, decimals), number(v.z, decimals)}));
  }

  [[nodiscard]] static simeco::Module module(std::string letter, std::vector<simeco::ExprId> arguments = {}) {
    return {std::move(letter), std::move(arguments), {}};
  }
  [[nodiscard]] simeco::Module organ(const char* letter, int stage) { return module(letter, {whole(stage)}); }
  /// Appends rotr(..) and rotu(..), already rounded.
  void turn(std::vector<simeco::Module>& to, Turn turn, int decimals) {
    to.push_back(module("rotr", {printed(turn.rotr.radians(), decimals)}));
    to.push_back(module("rotu", {printed(turn.rotu.radians(), decimals)}));
  }
  [[nodiscard]] static simeco::Production rule(std::vector<simeco::Module> predecessor, std::vector<simeco::Module> successor) {
    simeco::Production production;
    production.predecessor = std::move(predecessor);
    production.successors.push_back({std::move(successor), std::nullopt});
    return production;
  }

 private:
  simeco::Grammar& grammar_;
};

}  // namespace axil::emit
