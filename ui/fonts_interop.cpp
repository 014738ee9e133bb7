#include "ui/fonts_interop.hpp"

#include "base/text.hpp"

#include <imgui.h>

#include <cmath>
#include <filesystem>
#include <vector>

namespace axil::ui {
namespace {

constexpr const char* kFontFile = "/usr/share/fonts/truetype/wqy/wqy-microhei.ttc";
constexpr int kProportional = 0, kMono = 1;

std::uint32_t codePointAt(std::string_view text, std::size_t at, std::size_t length) {
  if (length == 1) return static_cast<unsigned char>(text[at]);
  std::uint32_t code = static_cast<unsigned char>(text[at]) & (0xFFu >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) code = code << 6 | (static_cast<unsigned char>(text[at + i]) & 0x3Fu);
  return code;
}

void add(float pixels, int face, const ImWchar* ranges) {
  ImFontConfig config;
  config.OversampleH = 1;
  config.PixelSnapH = true;
  config.FontNo = face;
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  if (FontBook::isInstalled()) {
    atlas.AddFontFromFileTTF(kFontFile, pixels, &config, ranges);
    return;
  }
  ImFontConfig plain;
  plain.SizePixels = pixels;
  atlas.AddFontDefault(&plain);
}

}  // namespace

bool FontBook::isInstalled() {
  static const bool found = std::filesystem::exists(kFontFile);
  return found;
}

void FontBook::want(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = utf8Length(text[at]);
    if (at + length > text.size()) return;
    const std::uint32_t code = codePointAt(text, at, length);
    if (code >= 0x80 && code < wanted_.size() && !wanted_.test(code)) {
      wanted_.set(code);
      isNew_ = true;
    }
    at += length;
  }
}

bool FontBook::prepare(float scale) {
  if (!isNew_ && scale == scale_) return false;
  isNew_ = false;
  scale_ = scale;
  ImFontGlyphRangesBuilder builder;
  static constexpr ImWchar kLatin[] = {0x0020, 0x00FF, 0x2010, 0x2027, 0x2190, 0x2193, 0};
  builder.AddRanges(kLatin);
  for (std::size_t code = 0x80; code < wanted_.size(); ++code)
    if (wanted_.test(code)) builder.AddChar(static_cast<ImWchar>(code));
  ImVector<ImWchar> ranges;
  builder.BuildRanges(&ranges);
  ImGui::GetIO().Fonts->Clear();
  ImGui::GetIO().Fonts->Flags |= ImFontAtlasFlags_NoBakedLines;  // they would want a smoothed texture
  add(std::round(16 * scale), kProportional, ranges.Data);
  add(std::round(13.5f * scale), kProportional, ranges.Data);
  add(std::round(20 * scale), kProportional, ranges.Data);
  add(std::round(14.5f * scale), kMono, ranges.Data);
  return ImGui::GetIO().Fonts->Build();
}

}  // namespace axil::ui
