#include "simeco/engine_surroundings.hpp"

namespace axil::simeco {

namespace {

enum class Role : std::uint8_t { Considered, Ignored, Opens, Closes };

std::array<Role, 256> rolesOf(const Program& program, const std::array<bool, 256>& ignored) {
  std::array<Role, 256> roles{};
  for (std::size_t code = 0; code < 256; ++code)
    roles[code] = program.opens[code] ? Role::Opens : program.closes[code] ? Role::Closes : ignored[code] ? Role::Ignored : Role::Considered;
  return roles;
}

bool hasParameters(const std::vector<Pattern>& patterns, const Program& program) {
  for (const Pattern& pattern : patterns)
    if (pattern.kind == Pattern::Kind::Symbol && program.parameterCount[pattern.code] > 0) return true;
  return false;
}

void addNeeds(const RuleTable& table, const Program& program, bool plain, SurroundingNeeds& needs) {
  for (const CompiledRule& rule : table.rules) {
    needs.left = needs.left || (plain && !rule.left.empty());
    needs.right = needs.right || (plain && !rule.right.empty() && rule.simpleRight);
    needs.brackets = needs.brackets || (!rule.right.empty() && (!plain || !rule.simpleRight)) || (!rule.left.empty() && !plain);
    needs.offsets = needs.offsets || hasParameters(rule.left, program) || hasParameters(rule.right, program);
  }
}

}  // namespace

SurroundingNeeds needsOf(const Program& program) {
  SurroundingNeeds needs;
  for (const System& system : program.systems) {
    const bool plain = program.systems.size() == 1 && !system.ring;
    addNeeds(system.productions, program, plain, needs);
    addNeeds(system.decomposition, program, plain, needs);
    addNeeds(system.homomorphism, program, plain, needs);
    addNeeds(system.interaction, program, plain, needs);
  }
  return needs;
}

void Surroundings::readLeft(const Program& program, const std::array<bool, 256>& ignored, std::span<const SymbolCode> codes) {
  const auto roles = rolesOf(program, ignored);
  left_.setSize(codes.size());
  leftStack_.clear();
  std::uint32_t last = nowhere;
  for (std::size_t i = 0; i < codes.size(); ++i) {
    left_[i] = last;
    switch (roles[codes[i]]) {
      case Role::Considered: last = static_cast<std::uint32_t>(i); break;
      case Role::Ignored: break;
      case Role::Opens: leftStack_.push(last); break;
      case Role::Closes:
        last = leftStack_.size() == 0 ? nowhere : leftStack_[leftStack_.size() - 1];
        if (leftStack_.size() > 0) leftStack_.setSize(leftStack_.size() - 1);
        break;
    }
  }
}

void Surroundings::readRight(const Program& program, const std::array<bool, 256>& ignored, std::span<const SymbolCode> codes) {
  const auto roles = rolesOf(program, ignored);
  right_.setSize(codes.size());
  rightStack_.clear();
  std::uint32_t next = nowhere;
  for (std::size_t i = codes.size(); i-- > 0;) {
    right_[i] = next;
    switch (roles[codes[i]]) {
      case Role::Considered: next = static_cast<std::uint32_t>(i); break;
      case Role::Ignored: break;
      case Role::Closes:
        rightStack_.push(next);
        next = nowhere;
        break;
      case Role::Opens:
        next = rightStack_.size() == 0 ? nowhere : rightStack_[rightStack_.size() - 1];
        if (rightStack_.size() > 0) rightStack_.setSize(rightStack_.size() - 1);
        break;
    }
  }
}

void Surroundings::readBrackets(const Program& program, std::span<const SymbolCode> codes) {
  partner_.setSize(codes.size());
  bracketStack_.clear();
  for (std::size_t i = 0; i < codes.size(); ++i) {
    partner_[i] = nowhere;
    if (program.opens[codes[i]]) bracketStack_.push(static_cast<std::uint32_t>(i));
    if (!program.closes[codes[i]] || bracketStack_.size() == 0) continue;
    const std::uint32_t open = bracketStack_[bracketStack_.size() - 1];
    bracketStack_.setSize(bracketStack_.size() - 1);
    partner_[i] = open;
    partner_[open] = static_cast<std::uint32_t>(i);
  }
}

void Surroundings::readOffsets(const Program& program, std::span<const SymbolCode> codes) {
  offsets_.read(program, codes);
}

void Surroundings::read(const Program& program, const std::array<bool, 256>& ignored, const SurroundingNeeds& needs, std::span<const SymbolCode> codes) {
  if (needs.left) readLeft(program, ignored, codes);
  if (needs.right) readRight(program, ignored, codes);
  if (needs.brackets) readBrackets(program, codes);
  if (needs.offsets) readOffsets(program, codes);
}

}  // namespace axil::simeco
