#pragma once
/// \file
/// Private to render: a line of words as a picture, for sheets that are read.

#include <cstdint>
#include <string>
#include <vector>

namespace axil::render {

/// How much of each pixel the letters cover, 0 to 255; rows from the top. Empty for words of which the font has none.
struct SheetText {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> coverage;
};

/// One line of UTF-8. Without a font for Chinese letters, words that have some give nothing.
[[nodiscard]] SheetText textOf(const std::string& words, int size_px);

}  // namespace axil::render
