#pragma once
/// \file
/// Id<Tag>: a typed number that names a thing inside its owner (a node of a skeleton, an expression of a grammar).
/// Ids are the only cross references between values; they are meaningless away from their owner.

#include <compare>
#include <cstdint>
#include <functional>

namespace axil {

template <class Tag>
struct Id {
  std::int32_t value = -1;

  constexpr Id() = default;
  explicit constexpr Id(std::int32_t v) : value(v) {}
  [[nodiscard]] constexpr bool valid() const { return value >= 0; }
  friend constexpr auto operator<=>(Id, Id) = default;
};

}  // namespace axil

template <class Tag>
struct std::hash<axil::Id<Tag>> {
  std::size_t operator()(axil::Id<Tag> id) const noexcept { return std::hash<std::int32_t>{}(id.value); }
};
