#include "ui/theme.hpp"

#include <array>

namespace axil::ui {
namespace {

constexpr Palette kDark{.ground = rgb(0x14181A), .panel = rgb(0x1B2022), .raised = rgb(0x272E30), .hovered = rgb(0x333C3E), .line = rgb(0x343D3F),
                        .text = rgb(0xE6EBE8), .quiet = rgb(0x93A09C), .accent = rgb(0x7CC36A), .onAccent = rgb(0x0E1A0B), .accentSoft = rgb(0x2A3B2B),
                        .predicted = rgb(0x6FA0EA), .warning = rgb(0xE5B04B), .error = rgb(0xF0776B), .photo = rgb(0x0F1213)};
constexpr Palette kLight{.ground = rgb(0xE4E7E3), .panel = rgb(0xF6F7F4), .raised = rgb(0xFFFFFF), .hovered = rgb(0xE6ECE2), .line = rgb(0xD3D9D1),
                         .text = rgb(0x1D2522), .quiet = rgb(0x64706B), .accent = rgb(0x3C7F34), .onAccent = rgb(0xFFFFFF), .accentSoft = rgb(0xDCEBD6),
                         .predicted = rgb(0x3F73C9), .warning = rgb(0x9A6400), .error = rgb(0xB53326), .photo = rgb(0xCDD2CC)};

// Told apart by people with any colour vision when neighbours differ in lightness too; after Okabe and Ito, on photos of green plants.
constexpr std::array<Colour, 10> kStems = {rgb(0xFFB000), rgb(0x56B4E9), rgb(0xFF5C8A), rgb(0xF0E442), rgb(0x785EF0),
                                           rgb(0xFE6100), rgb(0x00C9A7), rgb(0xE6A8FF), rgb(0xB8E986), rgb(0x3D7BFF)};

}  // namespace

const Palette& paletteOf(Theme theme) { return theme == Theme::Dark ? kDark : kLight; }

Colour colourOf(skeleton3d::StemId stem) { return kStems[static_cast<std::size_t>(stem.value < 1 ? 0 : stem.value - 1) % kStems.size()]; }

Mark markOf(skeleton3d::StemId stem) { return static_cast<Mark>((stem.value < 1 ? 0 : stem.value - 1) % 4); }

}  // namespace axil::ui
