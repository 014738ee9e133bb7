#pragma once
/// \file
/// Identities: who a module is, whatever stands elsewhere in the string. A module that a rule makes gets an identity from its
/// parent's identity and from its place among the modules of its letter in the successor; an axiom's modules get theirs from their place
/// among those of their letter. A copied module keeps its own. Random draws belong to (seed, step, identity), so a rule that makes more
/// modules somewhere shifts nobody else's draws, nor does a bracket or a turn that is put into a successor. Private to the engine.
///
/// Only programs that draw carry them. 48 bits: among 20 million modules less than one pair is expected to share an identity.

#include "simeco/module_string.hpp"

#include <bit>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace axil::simeco {

inline constexpr std::uint64_t kIdentityBits = (std::uint64_t{1} << 48) - 1;

[[nodiscard]] inline std::uint64_t whoIs(const Identity& identity) {
  return std::uint64_t{identity.parts[0]} | std::uint64_t{identity.parts[1]} << 16 | std::uint64_t{identity.parts[2]} << 32;
}
[[nodiscard]] inline Identity identityOf(std::uint64_t who) {
  return {{static_cast<std::uint16_t>(who), static_cast<std::uint16_t>(who >> 16), static_cast<std::uint16_t>(who >> 32)}};
}

/// What all children of a module have in common; one of them is this plus its key.
[[nodiscard]] inline std::uint64_t familyOf(std::uint64_t who) {
  std::uint64_t z = who + 0x9E3779B97F4A7C15ull;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
  return z ^ (z >> 31);
}
[[nodiscard]] inline std::uint64_t childOf(std::uint64_t family, std::uint64_t key) { return (family + key) & kIdentityBits; }

/// The key of the n-th module of a letter (with its number of parameters) in a successor or axiom.
[[nodiscard]] inline std::uint64_t childKey(std::string_view letter, std::size_t parameters, std::size_t nth) {
  std::uint64_t hash = 0xCBF29CE484222325ull;  // FNV-1a
  for (const char c : letter) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3ull;
  return familyOf(familyOf(hash + parameters) + nth) & kIdentityBits;
}

/// Writes one identity in one piece, and two bytes behind it: identities are written in order, and a Buffer has room behind its end.
inline void writeIdentity(Identity* to, std::uint64_t who) {
  if constexpr (std::endian::native == std::endian::little)
    std::memcpy(static_cast<void*>(to), &who, sizeof who);
  else
    *to = identityOf(who);
}

/// Writes the children's identities: one a key.
inline void writeChildren(Identity* to, std::uint64_t who, const std::uint64_t* keys, std::size_t count) {
  const std::uint64_t family = familyOf(who);
  for (std::size_t i = 0; i < count; ++i) writeIdentity(to + i, childOf(family, keys[i]));
}

}  // namespace axil::simeco
