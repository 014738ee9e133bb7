#pragma once
/// \file
/// A contact sheet: shapes in rows under headings, each with its name in English and Chinese. Flat leaves are drawn as a botanist draws
/// them, outline and veins seen from above; whole organs and small plants as they are lit in a picture.
///
/// Chinese labels need a font that has the letters (the one the window uses); without it a sheet has the English ones alone.

#include "base/result.hpp"
#include "organs/leaf.hpp"
#include "render/picture.hpp"
#include "render/types.hpp"

#include <string>
#include <variant>
#include <vector>

namespace axil::render {

/// A blade from above. What is shown reaches from `from` to `to` along the midrib (0 base, 1 apex): a whole blade, or one end of it.
struct FlatLeaf {
  organs::LeafShape shape;
  double from = -0.3;
  double to = 1.2;
};

struct GalleryCell {
  std::string english;
  std::string chinese;
  std::variant<FlatLeaf, PlantMesh> drawing;
  ViewPreset view = ViewPreset::ThreeQuarter;  ///< of a mesh
};

struct GallerySection {
  std::string english;
  std::string chinese;
  std::vector<GalleryCell> cells;
};

struct GalleryOptions {
  int columns = 10;
  int cell_px = 190;  ///< width and height of a drawing, without its label
};

/// Fails with BadInput for options out of range, with NoAnswer where the machine cannot draw, with LimitReached above maximumPixels.
[[nodiscard]] Result<Image> drawGallery(const std::vector<GallerySection>& sections, const GalleryOptions& options = {});

/// Parts of one organ as something to draw: each part its own material, the organ's colours as they are.
[[nodiscard]] PlantMesh meshOfParts(const std::vector<organs::Part>& parts, const std::string& name);

}  // namespace axil::render
