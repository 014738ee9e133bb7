#pragma once
/// \file
/// Colour: between the linear light that shading counts in and the sRGB that pictures and grammars hold, and from the
/// colours that grammars name to colours that plants have. Old grammars say RGBA(0, 1, 0, 1) and mean "green".

#include "simeco/grammar.hpp"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstdint>

namespace axil::render {

/// sRGB 0 to 1 to linear, and back (IEC 61966-2-1); values outside are clamped.
[[nodiscard]] glm::vec3 linearFromSrgb(const glm::dvec3& srgb);
[[nodiscard]] glm::dvec3 srgbFromLinear(const glm::vec3& linear);
/// A linear colour as three sRGB bytes, rounded to nearest.
struct Rgb8 {
  std::uint8_t r = 0, g = 0, b = 0;
  friend bool operator==(const Rgb8&, const Rgb8&) = default;
};
[[nodiscard]] Rgb8 rgb8FromLinear(const glm::vec3& linear);

/// The linear colour that an organ named with the sRGB colour `named` is drawn in. The hue stays (greens move a little
/// towards yellow, as leaves are), strength and brightness come down to what that kind of organ has; a colour that is
/// already as muted stays as it is. Alpha is not looked at.
[[nodiscard]] glm::vec3 naturalColour(const glm::dvec4& named, simeco::OrganKind kind);

/// The linear colour of what an L-system's turtle fills or outlines in the sRGB colour `named`: greens as of a leaf, all other
/// hues as strong and bright as of a flower.
[[nodiscard]] glm::vec3 paintColour(const glm::dvec4& named);

/// The linear colour of an organ that its grammar gives none.
[[nodiscard]] glm::vec3 defaultColour(simeco::OrganKind kind);
/// What a stem goes over to as it thickens.
[[nodiscard]] glm::vec3 barkColour();

}  // namespace axil::render
