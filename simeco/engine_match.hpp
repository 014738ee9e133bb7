#pragma once
/// \file
/// Matcher: whether a rule applies at a place of the old string, and with which parameters. Private to the engine.
///
/// Contexts are read from the old string: with the tables of Surroundings where the rule says nothing about brackets, else by
/// walking (rings, contexts that name brackets or `=`, sub-L-systems with other ignored letters), which skips a branch in one step.

#include "simeco/engine_identity.hpp"
#include "simeco/engine_surroundings.hpp"

#include <span>

namespace axil::simeco {

/// A string as it is read: codes, all parameters, and where they start when that is known.
struct OldString {
  std::span<const SymbolCode> codes;
  std::span<const double> parameters;
  std::span<const Identity> identities;  ///< none where nothing draws

  [[nodiscard]] std::uint64_t who(std::size_t module) const { return module < identities.size() ? whoIs(identities[module]) : 0; }
};

class Matcher {
 public:
  Matcher(const Program& program, const System& system, OldString old, const Surroundings& around, bool walking)
      : program_(program), system_(system), old_(old), around_(around), walking_(walking || system.ring) {}

  /// Whether the contexts hold around modules [first, last]; their parameters go into `locals`.
  [[nodiscard]] bool contexts(const CompiledRule& rule, std::size_t first, std::size_t last, double* locals) const {
    return (rule.right.empty() || right(rule, last, locals)) && (rule.left.empty() || left(rule, first, locals));
  }

  /// The module at `at` with parameters from `parameters` against a pattern; binds on success.
  [[nodiscard]] static bool bind(const Pattern& pattern, const double* parameters, std::size_t count, double* locals) {
    for (const Demand& demand : pattern.demands)
      if (parameters[demand.offset] != demand.value) return false;
    for (std::size_t i = 0; i < count; ++i) locals[pattern.slot + i] = parameters[i];
    return true;
  }

 private:
  [[nodiscard]] bool meets(const Pattern& pattern, std::size_t at, double* locals) const {
    if (old_.codes[at] != pattern.code) return false;
    const std::size_t count = program_.parameterCount[pattern.code];
    return count == 0 || bind(pattern, old_.parameters.data() + around_.offset(at), count, locals);
  }

  [[nodiscard]] bool left(const CompiledRule& rule, std::size_t first, double* locals) const {
    if (walking_) return walkLeft(rule, first, locals);
    std::size_t at = first;
    for (const Pattern& pattern : rule.left) {
      at = around_.leftOf(at);
      if (at == nowhere || !meets(pattern, at, locals)) return false;
    }
    return true;
  }
  [[nodiscard]] bool right(const CompiledRule& rule, std::size_t last, double* locals) const {
    if (walking_ || !rule.simpleRight) return walkRight(rule, last, locals);
    std::size_t at = last;
    for (const Pattern& pattern : rule.right) {
      at = around_.rightOf(at);
      if (at == nowhere || !meets(pattern, at, locals)) return false;
    }
    return true;
  }

  [[nodiscard]] bool walkLeft(const CompiledRule& rule, std::size_t first, double* locals) const;
  [[nodiscard]] bool walkRight(const CompiledRule& rule, std::size_t last, double* locals) const;

  const Program& program_;
  const System& system_;
  OldString old_;
  const Surroundings& around_;
  bool walking_;
};

}  // namespace axil::simeco
