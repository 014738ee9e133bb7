#include "render/gallery.hpp"

#include "render/colour.hpp"
#include "render/picture.hpp"
#include "render/sheet_text.hpp"

#include <glm/geometric.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace axil::render {
namespace {

constexpr int kFiner = 4;  ///< flat leaves are drawn so many times larger and then averaged
constexpr int kMargin = 48, kGap = 14, kLabel = 46, kHeading = 78, kTitle = 110;
const cv::Scalar kPaper(250, 250, 247), kLeafGreen(112, 158, 82), kVeinGreen(172, 205, 142), kInk(46, 62, 36);

/// sRGB bytes of a sheet under construction; rows from the top.
class Sheet {
 public:
  Sheet(int width, int height) : pixels_(height, width, CV_8UC3, kPaper) {}
  void paste(const cv::Mat& picture, int x, int y) {
    const cv::Rect room(0, 0, pixels_.cols, pixels_.rows);
    const cv::Rect place = cv::Rect(x, y, picture.cols, picture.rows) & room;
    if (!place.empty()) picture(cv::Rect(place.x - x, place.y - y, place.width, place.height)).copyTo(pixels_(place));
  }
  /// Darkens the paper by a text's coverage.
  void write(const SheetText& text, int x, int y, const cv::Vec3d& ink) {
    for (int row = 0; row < text.height; ++row)
      for (int column = 0; column < text.width; ++column) {
        const int px = x + column, py = y + row;
        if (px < 0 || py < 0 || px >= pixels_.cols || py >= pixels_.rows) continue;
        const double cover = text.coverage[static_cast<std::size_t>(row) * static_cast<std::size_t>(text.width) + static_cast<std::size_t>(column)] / 255.0;
        cv::Vec3b& p = pixels_.at<cv::Vec3b>(py, px);
        for (int c = 0; c < 3; ++c) p[c] = static_cast<unsigned char>(std::lround(p[c] * (1 - cover) + ink[c] * cover));
      }
  }
  void line(int x, int y, int width) { cv::rectangle(pixels_, cv::Rect(x, y, width, 1), cv::Scalar(196, 204, 184), cv::FILLED); }
  [[nodiscard]] Image image() const {
    Image image{pixels_.cols, pixels_.rows, {}};
    image.rgb.assign(pixels_.datastart, pixels_.dataend);
    return image;
  }

 private:
  cv::Mat pixels_;
};

/// From a blade's plane to a cell's fine pixels.
struct Frame {
  double scale = 1;
  glm::dvec2 centre{};
  double half_px = 0;
  [[nodiscard]] cv::Point at(const glm::dvec2& p) const {
    constexpr double subpixels = 16;
    return {static_cast<int>(std::lround((half_px + (p.x - centre.x) * scale) * subpixels)), static_cast<int>(std::lround((half_px - (p.y - centre.y) * scale) * subpixels))};
  }
};
constexpr int kShift = 4;  ///< of the sixteenths above

Frame frameOf(const FlatLeaf& leaf, const std::vector<glm::vec2>& outline, int side_px) {
  glm::dvec2 low(1e9), high(-1e9);
  for (const glm::vec2& p : outline) {
    const double y = std::clamp<double>(p.y, leaf.from, leaf.to);
    if (p.y < leaf.from || p.y > leaf.to) {
      low.y = std::min(low.y, y);
      high.y = std::max(high.y, y);
      continue;
    }
    low = glm::min(low, glm::dvec2(p));
    high = glm::max(high, glm::dvec2(p));
  }
  if (leaf.from <= -0.25 && leaf.shape.shield == 0) low.y = std::min(low.y, -0.1);  // the petiole
  const double extent = std::max({high.x - low.x, high.y - low.y, 0.1});
  return {0.88 * side_px / extent, 0.5 * (low + high), 0.5 * side_px};
}

std::vector<cv::Point> pointsOf(const std::vector<glm::vec2>& line, const Frame& frame) {
  std::vector<cv::Point> points;
  for (const glm::vec2& p : line) points.push_back(frame.at(p));
  return points;
}

void stroke(cv::Mat& cell, const std::vector<glm::vec2>& line, const Frame& frame, const cv::Scalar& colour, double thickness_px) {
  cv::polylines(cell, pointsOf(line, frame), false, colour, std::max(1, static_cast<int>(std::lround(thickness_px))), cv::LINE_AA, kShift);
}

/// A vein gets thinner as it goes out.
void strokeVein(cv::Mat& cell, const organs::LeafVein& vein, const Frame& frame) {
  for (std::size_t i = 0; i + 1 < vein.points.size(); ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(vein.points.size());
    stroke(cell, {vein.points[i], vein.points[i + 1]}, frame, kVeinGreen, std::clamp(vein.thickness * frame.scale * (1 - 0.67 * share), 1.5, 2.6 * kFiner));
  }
}

cv::Scalar scalarOf(const glm::vec3& linear) {
  const Rgb8 c = rgb8FromLinear(linear);
  return {static_cast<double>(c.r), static_cast<double>(c.g), static_cast<double>(c.b)};
}

cv::Mat flatLeafCell(const FlatLeaf& leaf, int cell_px) {
  const int side = cell_px * kFiner;
  cv::Mat cell(side, side, CV_8UC3, kPaper);
  const std::vector<glm::vec2> outline = organs::leafOutline(leaf.shape);
  const Frame frame = frameOf(leaf, outline, side);
  if (leaf.shape.shield == 0 && leaf.from < 0)
    stroke(cell, {{0, -0.14f}, {0, 0.01f}}, frame, kInk, std::clamp(0.018 * frame.scale, 1.2 * kFiner, 2.4 * kFiner));
  for (const auto& hair : organs::leafHairs(leaf.shape)) stroke(cell, hair, frame, kInk, 0.8 * kFiner);
  const std::vector<std::vector<cv::Point>> polygon{pointsOf(outline, frame)};
  cv::fillPoly(cell, polygon, kLeafGreen, cv::LINE_AA, kShift);
  for (const organs::LeafVein& vein : organs::leafVeins(leaf.shape)) strokeVein(cell, vein, frame);
  for (const auto& spot : organs::leafSpots(leaf.shape)) cv::fillPoly(cell, std::vector<std::vector<cv::Point>>{pointsOf(spot, frame)}, scalarOf(leaf.shape.spotColour), cv::LINE_AA, kShift);
  cv::polylines(cell, polygon, true, kInk, static_cast<int>(1.3 * kFiner), cv::LINE_AA, kShift);
  cv::Mat small;
  cv::resize(cell, small, cv::Size(cell_px, cell_px), 0, 0, cv::INTER_AREA);
  return small;
}

/// The same picture of a mesh, over the sheet's paper.
Result<cv::Mat> meshCell(Painter& painter, const PlantMesh& mesh, ViewPreset view, int cell_px) {
  PictureOptions options;
  options.width_px = options.height_px = cell_px;
  options.view = view;
  options.background = linearFromSrgb(glm::dvec3{250, 250, 247} / 255.0);
  options.ground = Ground::None;
  options.smoothing = Smoothing::Fine;
  const auto image = painter.draw(mesh, options);
  if (!image) return image.failure();
  cv::Mat cell(cell_px, cell_px, CV_8UC3);
  std::copy(image->rgb.begin(), image->rgb.end(), cell.data);
  return cell;
}

struct Layout {
  int width = 0, height = 0;
};

int rowsOf(const GallerySection& section, const GalleryOptions& o) { return (static_cast<int>(section.cells.size()) + o.columns - 1) / o.columns; }

Layout layoutOf(const std::vector<GallerySection>& sections, const GalleryOptions& o) {
  Layout layout{2 * kMargin + o.columns * o.cell_px + (o.columns - 1) * kGap, kTitle + kMargin};
  for (const GallerySection& section : sections) layout.height += kHeading + rowsOf(section, o) * (o.cell_px + kLabel + kGap);
  return layout;
}

class Drawer {
 public:
  Drawer(Painter& painter, const GalleryOptions& options, const Layout& layout) : painter_(painter), o_(options), sheet_(layout.width, layout.height), width_(layout.width) {}

  Result<Image> drawn(const std::vector<GallerySection>& sections) {
    writeLeft("Shapes of leaves, flowers and fruits", "葉、花與果實的形狀", kMargin, 34, 34);
    int y = kTitle;
    for (const GallerySection& section : sections) {
      sheet_.line(kMargin, y + 6, width_ - 2 * kMargin);
      writeLeft(section.english, section.chinese, kMargin, y + 20, 25);
      y += kHeading;
      for (std::size_t i = 0; i < section.cells.size(); ++i) {
        const int column = static_cast<int>(i) % o_.columns, row = static_cast<int>(i) / o_.columns;
        if (auto done = drawCell(section.cells[i], kMargin + column * (o_.cell_px + kGap), y + row * (o_.cell_px + kLabel + kGap)); !done) return done.failure();
      }
      y += rowsOf(section, o_) * (o_.cell_px + kLabel + kGap);
    }
    return sheet_.image();
  }

 private:
  Result<void> drawCell(const GalleryCell& cell, int x, int y) {
    if (const FlatLeaf* leaf = std::get_if<FlatLeaf>(&cell.drawing)) {
      sheet_.paste(flatLeafCell(*leaf, o_.cell_px), x, y);
    } else {
      const auto picture = meshCell(painter_, std::get<PlantMesh>(cell.drawing), cell.view, o_.cell_px);
      if (!picture) return picture.failure();
      sheet_.paste(*picture, x, y);
    }
    writeCentred(cell.english, x, y + o_.cell_px + 2, 15);
    writeCentred(cell.chinese, x, y + o_.cell_px + 22, 15);
    return {};
  }
  void writeCentred(const std::string& words, int x, int y, int size_px) {
    const SheetText text = textOf(words, size_px);
    sheet_.write(text, x + (o_.cell_px - text.width) / 2, y, {52, 60, 46});
  }
  void writeLeft(const std::string& english, const std::string& chinese, int x, int y, int size_px) {
    const SheetText first = textOf(english, size_px);
    sheet_.write(first, x, y, {34, 54, 26});
    sheet_.write(textOf(chinese, size_px), x + first.width + size_px, y, {96, 116, 84});
  }

  Painter& painter_;
  const GalleryOptions& o_;
  Sheet sheet_;
  int width_;
};

}  // namespace

PlantMesh meshOfParts(const std::vector<organs::Part>& parts, const std::string& name) {
  PlantMesh mesh;
  mesh.name = name;
  OrganModel model{.name = name, .parts = {}, .placements = {Placement{}}};
  for (const organs::Part& part : parts) {
    const bool thin = part.name == "blade" || part.name == "petal" || part.name == "sepal" || part.name == "wing" || part.name == "calyx" || part.name == "vein" || part.name == "spot";
    mesh.materials.push_back({.name = part.name, .colour = part.colour, .roughness = 0.7f, .surface = thin ? Surface::Blade : Surface::Solid});
    model.parts.push_back({.material = static_cast<std::int32_t>(mesh.materials.size() - 1), .mesh = part.mesh});
  }
  mesh.models.push_back(std::move(model));
  return mesh;
}

Result<Image> drawGallery(const std::vector<GallerySection>& sections, const GalleryOptions& options) {
  if (options.columns < 1 || options.columns > 40 || options.cell_px < 40 || options.cell_px > 1000)
    return fail(ErrorCode::BadInput, "a gallery has 1 to 40 columns of cells of 40 to 1000 pixels");
  const Layout layout = layoutOf(sections, options);
  if (static_cast<std::int64_t>(layout.width) * layout.height > maximumPixels) return fail(ErrorCode::LimitReached, "the gallery has more than 100,000,000 pixels; make its cells smaller");
  auto painter = Painter::open();
  if (!painter) return painter.failure();
  return Drawer(*painter, options, layout).drawn(sections);
}

}  // namespace axil::render
