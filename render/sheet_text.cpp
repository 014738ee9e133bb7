#include "render/sheet_text.hpp"

#include <vtkAutoInit.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkStdString.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>
#include <vtkUnicodeString.h>

#include <algorithm>
#include <filesystem>

VTK_MODULE_INIT(vtkRenderingFreeType)

namespace axil::render {
namespace {

constexpr const char* kFontFile = "/usr/share/fonts/truetype/wqy/wqy-microhei.ttc";

bool hasFont() {
  static const bool found = std::filesystem::exists(kFontFile);
  return found;
}

bool isLatin(const std::string& words) {
  return std::all_of(words.begin(), words.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; });
}

}  // namespace

SheetText textOf(const std::string& words, int size_px) {
  if (words.empty() || (!hasFont() && !isLatin(words))) return {};
  vtkNew<vtkTextProperty> look;
  if (hasFont()) {
    look->SetFontFamily(VTK_FONT_FILE);
    look->SetFontFile(kFontFile);
  }
  look->SetFontSize(size_px);
  look->SetColor(1, 1, 1);
  vtkNew<vtkImageData> drawn;
  int size[2] = {0, 0};
  constexpr int dotsPerInch = 72;  // a point is a pixel
  vtkTextRenderer* renderer = vtkTextRenderer::GetInstance();
  if (renderer == nullptr || !renderer->RenderString(look.Get(), vtkStdString(words), drawn.Get(), size, dotsPerInch, static_cast<int>(vtkTextRenderer::FreeType))) return {};
  SheetText text{size[0], size[1], {}};
  int extent[6];
  drawn->GetExtent(extent);
  for (int row = size[1] - 1; row >= 0; --row)
    for (int column = 0; column < size[0]; ++column) {
      const auto* pixel = static_cast<const unsigned char*>(drawn->GetScalarPointer(extent[0] + column, extent[2] + row, extent[4]));
      text.coverage.push_back(pixel[3]);
    }
  return text;
}

}  // namespace axil::render
