#pragma once
/// \file
/// The lowest layer of compiling a grammar: which functions there are, which letters are which symbols, what was wrong. Private to program.cpp.

#include "base/overloaded.hpp"
#include "base/text.hpp"
#include "simeco/engine_arithmetic.hpp"
#include "simeco/engine_identity.hpp"

#include <algorithm>
#include <bit>
#include <map>
#include <set>

namespace axil::simeco {

inline constexpr FunctionRow kBoth[] = {{"exp", 1, Function::Exp},   {"log", 1, Function::Log},     {"sqrt", 1, Function::Sqrt},
                                 {"floor", 1, Function::Floor}, {"ceil", 1, Function::Ceil}, {"sign", 1, Function::Sign}};
inline constexpr FunctionRow kSimeco[] = {{"sin", 1, Function::Sin},       {"cos", 1, Function::Cos},     {"tan", 1, Function::Tan},
                                   {"asin", 1, Function::Asin},     {"acos", 1, Function::Acos},   {"atan", 1, Function::Atan},
                                   {"atan2", 2, Function::Atan2},   {"abs", 1, Function::Absolute}, {"round", 1, Function::Round},
                                   {"min", 2, Function::Minimum},   {"max", 2, Function::Maximum}, {"pow", 2, Function::Power},
                                   {"random", 2, Function::Random}, {"normal", 2, Function::Normal}};
inline constexpr FunctionRow kClassic[] = {{"sin", 1, Function::SinDegrees},   {"cos", 1, Function::CosDegrees},   {"tan", 1, Function::TanDegrees},
                                    {"asin", 1, Function::AsinDegrees}, {"acos", 1, Function::AcosDegrees}, {"atan", 1, Function::AtanDegrees},
                                    {"atan2", 2, Function::Atan2Degrees}, {"fabs", 1, Function::Absolute},  {"trunc", 1, Function::Round},
                                    {"ran", 1, Function::Ran},          {"nran", 2, Function::Nran},        {"bran", 2, Function::Bran},
                                    {"biran", 2, Function::Biran},      {"srand", 1, Function::SeedRandom}, {"stop", 1, Function::Stop},
                                    {"SetDerivationLength", 1, Function::SetLength}, {"GetDerivationLength", 1, Function::GetLength}};

inline bool isComparison(Op op) { return op >= Op::Less && op <= Op::NotEqual; }

/// -0 and 0 are one number where rules are looked up by it.
inline std::uint64_t bitsOf(double value) { return std::bit_cast<std::uint64_t>(value == 0 ? 0.0 : value); }

/// Which names mean what, inside one rule or block.
struct Scope {
  std::map<std::string, std::uint16_t, std::less<>> locals;
  const System* system = nullptr;
};

inline std::optional<std::int32_t> indexIn(const std::vector<std::string>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<std::int32_t>(found - names.begin());
}

/// Gathers symbols and errors while a grammar is compiled.
class SymbolCompiler {
 public:
  SymbolCompiler(const Grammar& grammar, const CompileOptions& options) : grammar_(grammar), options_(options) { program_.language = grammar.language; }

 protected:
  void error(std::string message) {
    if (std::find(errors_.begin(), errors_.end(), message) == errors_.end()) errors_.push_back(where_ + std::move(message));
  }

  SymbolCode codeOf(const std::string& letter, std::size_t parameters) {
    const std::pair<std::string, std::size_t> key{letter, parameters};
    if (const auto known = codes_.find(key); known != codes_.end()) return known->second;
    if (parameters > 255) {
      error("module " + letter + " has " + std::to_string(parameters) + " parameters; at most 255 are possible");
      return 0;
    }
    if (symbols_.size() >= maximumSymbols) {
      error("more than " + std::to_string(maximumSymbols) + " different modules (a letter with a number of parameters); use fewer letters");
      return 0;
    }
    const auto code = static_cast<SymbolCode>(symbols_.size());
    symbols_.push_back({letter, static_cast<int>(parameters)});
    codes_.emplace(key, code);
    return code;
  }
  SymbolCode codeOf(const Module& module) { return codeOf(module.letter, module.arguments.size()); }

  void intern(const std::vector<Module>& modules) {
    for (const Module& module : modules) (void)codeOf(module);
  }
  void intern(const std::vector<Production>& productions) {
    for (const Production& production : productions) {
      intern(production.left);
      intern(production.predecessor);
      intern(production.right);
      for (const Successor& successor : production.successors) intern(successor.modules);
    }
  }
  void internAll(const RuleSet& rules) {
    intern(rules.axiom);
    intern(rules.productions);
    intern(rules.interaction);
    if (rules.decomposition) intern(rules.decomposition->productions);
    if (rules.homomorphism) intern(rules.homomorphism->productions);
  }
  void describeSymbols() {
    for (std::size_t code = 0; code < symbols_.size(); ++code) {
      const Symbol& symbol = symbols_[code];
      program_.parameterCount[code] = static_cast<std::uint8_t>(symbol.parameters);
      program_.opens[code] = symbol.letter == "[";
      program_.closes[code] = symbol.letter == "]";
      if (symbol.letter == "%" && symbol.parameters == 0) program_.cut = static_cast<int>(code);
      if (symbol.letter == "?" && symbol.parameters == 2) program_.enter = static_cast<int>(code);
      if (symbol.letter == "$" && symbol.parameters == 0) program_.leave = static_cast<int>(code);
    }
  }

  const Grammar& grammar_;
  CompileOptions options_;
  Program program_;
  std::vector<Symbol> symbols_;
  std::map<std::pair<std::string, std::size_t>, SymbolCode> codes_;
  std::vector<std::string> errors_;
  std::string where_;  ///< "in the rule ...: ", for what is found now
};

}  // namespace axil::simeco
