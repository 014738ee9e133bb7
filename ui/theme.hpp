#pragma once
/// \file
/// Colours: the window's own, dark or light, and the stems'. A colour is packed as the window library wants it: red in the lowest byte.

#include "skeleton3d/types.hpp"

#include <cstdint>

namespace axil::ui {

using Colour = std::uint32_t;

[[nodiscard]] constexpr Colour rgb(std::uint32_t hex, std::uint32_t alpha = 255) {
  return (hex >> 16 & 255u) | (hex & 0xFF00u) | (hex & 255u) << 16 | alpha << 24;
}
[[nodiscard]] constexpr Colour withAlpha(Colour colour, std::uint32_t alpha) { return (colour & 0x00FFFFFFu) | alpha << 24; }

enum class Theme { Dark, Light };

struct Palette {
  Colour ground;      ///< behind everything
  Colour panel;
  Colour raised;      ///< cards, fields
  Colour hovered;
  Colour line;
  Colour text;
  Colour quiet;       ///< text that stands back
  Colour accent;
  Colour onAccent;
  Colour accentSoft;  ///< behind what is chosen
  Colour predicted;   ///< what goes on beyond the measured plant
  Colour warning;
  Colour error;
  Colour photo;       ///< around photos
};
[[nodiscard]] const Palette& paletteOf(Theme theme);

/// A stem has the same colour and the same mark everywhere, so that stems differ by more than hue.
enum class Mark { Disc, Square, Diamond, Triangle };
[[nodiscard]] Colour colourOf(skeleton3d::StemId stem);
[[nodiscard]] Mark markOf(skeleton3d::StemId stem);

}  // namespace axil::ui
