#include "render/picture.hpp"

#include "base/files.hpp"
#include "base/overloaded.hpp"
#include "render/colour.hpp"
#include "render/flat_mesh.hpp"
#include "render/headless_window.hpp"
#include "render/obstacles.hpp"
#include "render/parallel.hpp"
#include "render/plant_layer.hpp"
#include "skeleton3d/camera.hpp"

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace axil::render {
namespace {

using skeleton3d::Camera;
using skeleton3d::CameraModel;

// ---- the camera ------------------------------------------------------------------------------------------------------

/// A long lens, as for a portrait: so many picture heights (or widths) of focal length.
constexpr double focalLengths = 2.3;
/// Share of the picture left free on each side.
constexpr double freeMargin = 0.075;
constexpr Angle threeQuarterTurn = 38_deg, threeQuarterLift = 14_deg;

glm::dmat3 rotationOf(ViewPreset preset) {
  switch (preset) {
    case ViewPreset::Front: return *skeleton3d::nominalRotation("front");
    case ViewPreset::Right: return *skeleton3d::nominalRotation("right");
    case ViewPreset::Top: return *skeleton3d::nominalRotation("top");
    case ViewPreset::ThreeQuarter: break;
  }
  const double lift = threeQuarterLift.radians(), turn = threeQuarterTurn.radians();
  const glm::dvec3 towardsCamera{std::sin(turn) * std::cos(lift), std::sin(lift), std::cos(turn) * std::cos(lift)};
  return skeleton3d::rotationLookingAlong(PlantDirection::along(-towardsCamera), PlantDirection::up());
}

std::vector<glm::vec3> pointsToShow(const PlantMesh& mesh) {
  FlatMesh flat = flattened(mesh);
  if (!flat.positions.empty()) return std::move(flat.positions);
  const glm::vec3 collar(mesh.collar.at);
  return {collar + glm::vec3(-0.5f, 0, -0.5f), collar + glm::vec3(0.5f, 1, 0.5f)};
}

/// The least distance and the sideways shift from which all points lie between two planes through the camera that open
/// by `slope` to either side: the four planes of a picture decide alone, so the fit is exact.
struct SideFit {
  double most = -1e300, least = -1e300;  ///< max of (a - slope z) and of (-a - slope z)
  void add(double across, double depth, double slope) {
    most = std::max(most, across - slope * depth);
    least = std::max(least, -across - slope * depth);
  }
  [[nodiscard]] double shift() const { return 0.5 * (most - least); }
  [[nodiscard]] double distance(double slope) const { return 0.5 * (most + least) / slope; }
};

// ---- the room --------------------------------------------------------------------------------------------------------

/// The studio: sRGB at the top and at the foot of the picture, and the colour that full shadow leaves of the floor.
const glm::dvec3 wallTop{0.915, 0.905, 0.885}, wallFoot{0.835, 0.820, 0.795};
const glm::dvec3 shadowTint{0.30, 0.31, 0.33};

/// sRGB bytes of linear light, from a table: a picture has millions of pixels and few colours.
class Encoder {
 public:
  Encoder() {
    for (std::size_t i = 0; i < table_.size(); ++i)
      table_[i] = static_cast<float>(srgbFromLinear(glm::vec3(static_cast<float>(i) / static_cast<float>(table_.size() - 1))).r * 255.0);
  }
  /// 0 to 255, not rounded.
  [[nodiscard]] float operator()(double linear) const {
    const double at = std::clamp(linear, 0.0, 1.0) * static_cast<double>(table_.size() - 1);
    const auto i = std::min(static_cast<std::size_t>(at), table_.size() - 2);
    const auto share = static_cast<float>(at - static_cast<double>(i));
    return table_[i] * (1 - share) + table_[i + 1] * share;
  }

 private:
  std::array<float, 8192> table_{};
};

/// Linear colour of the room behind pixel row `y`.
glm::dvec3 backgroundAt(const Background& background, double y, int height_px) {
  return std::visit(overloaded{[&](const StudioBackground&) {
                                 const double t = std::clamp(y / height_px, 0.0, 1.0);
                                 return glm::dvec3(linearFromSrgb(glm::mix(wallTop, wallFoot, t * t * (3 - 2 * t))));
                               },
                               [](const glm::vec3& colour) { return glm::dvec3(colour); }},
                    background);
}

/// How much of the open floor's light the floor at a pixel gets; 1 where the pixel shows no floor.
class Floor {
 public:
  Floor(const Camera& camera, const GroundShade& shade, double height)
      : camera_(camera), shade_(shade), height_(height), toPlant_(glm::transpose(camera.rotation)), eye_(-(toPlant_ * camera.translation)),
        distorted_(camera.distortion != std::array<double, 5>{}) {}

  [[nodiscard]] double lightAt(PhotoPoint pixel) const {
    if (shade_.cell <= 0) return 1;
    const bool perspective = camera_.model == CameraModel::Perspective;
    // As skeleton3d::rayThrough, which is too slow for every pixel of a picture; the lens alone is left to it.
    const glm::dvec2 focal = perspective ? *camera_.focal_px : glm::dvec2(camera_.scale_px_per_unit);
    const glm::dvec2 onLens = distorted_ ? skeleton3d::undistorted(camera_, pixel) : (pixel.px - camera_.centre_px) / focal;
    const glm::dvec3 from = perspective ? eye_ : eye_ + toPlant_ * glm::dvec3(onLens, 0);
    const glm::dvec3 towards = perspective ? toPlant_ * glm::dvec3(onLens, 1) : toPlant_[2];
    if (towards.y > -1e-6) return 1;
    const double along = (from.y - height_) / -towards.y;
    if (perspective && along <= 0) return 1;
    return shade_.at(from.x + towards.x * along, from.z + towards.z * along);
  }

 private:
  const Camera& camera_;
  const GroundShade& shade_;
  double height_;
  glm::dmat3 toPlant_;
  glm::dvec3 eye_;
  bool distorted_;
};

/// Half a step of brightness up or down, without a pattern: the wall's steps of one in 256 would show as bands.
float grainAt(std::size_t x, std::size_t y) {
  std::uint32_t h = static_cast<std::uint32_t>(x) * 0x9E3779B1u ^ static_cast<std::uint32_t>(y) * 0x85EBCA77u;
  h = (h ^ (h >> 15)) * 0x2C1B3C6Du;
  h = (h ^ (h >> 12)) * 0x297A2D39u;
  return static_cast<float>(h >> 8) * (1.0f / 16777216.0f) - 0.5f;
}

/// The plant over floor and wall.
Image composed(const Layer& plant, const Floor& floor, const Background& background) {
  Image image{.width_px = plant.width_px, .height_px = plant.height_px, .rgb = std::vector<std::uint8_t>(plant.rgba.size() / 4 * 3)};
  const Encoder encode;
  inParallel(static_cast<std::size_t>(plant.height_px), [&](std::size_t y) {
    const std::size_t row = y * static_cast<std::size_t>(plant.width_px);
    const glm::dvec3 wall = backgroundAt(background, static_cast<double>(y) + 0.5, plant.height_px);
    const glm::vec3 open{encode(wall.r), encode(wall.g), encode(wall.b)};
    for (std::size_t x = 0; x < static_cast<std::size_t>(plant.width_px); ++x) {
      const std::uint8_t* over = plant.rgba.data() + 4 * (row + x);
      std::uint8_t* to = image.rgb.data() + 3 * (row + x);
      glm::vec3 under = open;
      if (over[3] < 255) {
        const double light = floor.lightAt({{static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5}});
        if (light != 1) {
          const glm::dvec3 dark = wall * (shadowTint + (1.0 - shadowTint) * light);
          under = {encode(dark.r), encode(dark.g), encode(dark.b)};
        }
      }
      const float through = 1 - static_cast<float>(over[3]) / 255, grain = grainAt(x, y);
      for (int channel = 0; channel < 3; ++channel)
        to[channel] = static_cast<std::uint8_t>(std::min(static_cast<float>(over[channel]) + through * (under[channel] + grain) + 0.5f, 255.0f));
    }
  });
  return image;
}

Result<Camera> cameraOf(const PlantMesh& mesh, const PictureOptions& options) {
  if (const auto* preset = std::get_if<ViewPreset>(&options.view))
    return cameraFitting(withObstacles(mesh, obstaclesToFrame(mesh, options.obstacles)), *preset, options.width_px, options.height_px);
  const Camera& camera = std::get<Camera>(options.view);
  if (camera.model == CameraModel::Unknown)
    return fail(ErrorCode::BadInput, "a picture cannot be drawn with an unknown camera; give its focal length or scale, or choose a view by name");
  if (const auto checked = skeleton3d::checkCamera(camera, "picture", {options.width_px, options.height_px}); !checked) return checked.failure();
  return camera;
}

Result<void> checkSize(const PictureOptions& options) {
  const std::string size = std::to_string(options.width_px) + " x " + std::to_string(options.height_px);
  if (options.width_px < 1 || options.height_px < 1) return fail(ErrorCode::BadInput, "a picture of " + size + " pixels has no area; both sides must be at least 1");
  if (std::int64_t{options.width_px} * options.height_px > maximumPixels)
    return fail(ErrorCode::LimitReached, "a picture of " + size + " pixels is too large; the limit is " + std::to_string(maximumPixels / 1'000'000) + " megapixels");
  return {};
}

}  // namespace

Camera cameraFitting(const PlantMesh& mesh, ViewPreset preset, int width_px, int height_px) {
  const glm::dmat3 rotation = rotationOf(preset);
  const double focal = focalLengths * std::max(width_px, height_px);
  const double slopeX = (0.5 - freeMargin) * width_px / focal, slopeY = (0.5 - freeMargin) * height_px / focal;
  SideFit x, y;
  Bounds bounds;
  for (const glm::vec3& p : pointsToShow(mesh)) {
    const glm::dvec3 at = rotation * glm::dvec3(p);
    x.add(at.x, at.z, slopeX);
    y.add(at.y, at.z, slopeY);
    bounds.add(at);
  }
  // A single point would be met by the camera itself.
  const double standOff = glm::length(bounds.size()) > 0 ? 0 : 1;
  const double distance = std::max(x.distance(slopeX), y.distance(slopeY)) + standOff;
  Camera camera;
  camera.model = CameraModel::Perspective;
  camera.focal_px = glm::dvec2(focal);
  camera.centre_px = {0.5 * width_px, 0.5 * height_px};
  camera.rotation = rotation;
  camera.translation = {-x.shift(), -y.shift(), distance};
  return camera;
}

struct Painter::Inside {
  explicit Inside(HeadlessWindow opened) : window(std::move(opened)) {}
  HeadlessWindow window;
};

Painter::Painter(std::unique_ptr<Inside> inside) : inside_(std::move(inside)) {}
Painter::Painter(Painter&&) noexcept = default;
Painter& Painter::operator=(Painter&&) noexcept = default;
Painter::~Painter() = default;

Result<Painter> Painter::open() {
  auto window = HeadlessWindow::open();
  if (!window) return window.failure();
  return Painter(std::make_unique<Inside>(std::move(window).value()));
}

double floorUnder(const PlantMesh& mesh) {
  constexpr double kStands = 0.1;  // a thick stem's rounded foot, a drooping leaf tip
  const Bounds bounds = boundsOf(mesh);
  const double collar = mesh.collar.at.y;
  if (bounds.empty()) return collar;
  const glm::dvec3 size = bounds.size();
  return collar - bounds.low.y > kStands * std::max({size.x, size.y, size.z}) ? bounds.low.y : collar;
}

Result<Image> Painter::draw(const PlantMesh& plant, const PictureOptions& options) {
  if (const auto checked = checkSize(options); !checked) return checked.failure();
  const auto camera = cameraOf(plant, options);
  if (!camera) return camera.failure();

  const bool onGround = options.ground == Ground::Shadow;
  const double floorHeight = options.floorHeight.value_or(floorUnder(plant));
  const std::optional<PlantMesh> around = options.obstacles.empty() ? std::nullopt : std::optional(withObstacles(plant, options.obstacles));
  const PlantMesh& mesh = around ? *around : plant;
  const FlatMesh flat = flattened(mesh, Tint::Natural);
  const Daylight daylight = daylightOn(flat, {.groundHeight = floorHeight, .ground = onGround ? GroundLight::Shaded : GroundLight::None});
  const bool looksDown = skeleton3d::rayThrough(*camera, {camera->centre_px}).origin.at.y > floorHeight;
  const LayerScene scene{.plant = mesh, .mesh = flat, .light = daylight.vertices, .camera = *camera,
                         .floor = onGround && looksDown ? std::optional(floorHeight) : std::nullopt};
  const auto layer = drawLayer(inside_->window, scene, {options.width_px, options.height_px, options.smoothing == Smoothing::Fine ? 4 : 0});
  if (!layer) return layer.failure();
  return composed(*layer, Floor(*camera, daylight.ground, floorHeight), options.background);
}

Result<Image> drawPlant(const PlantMesh& mesh, const PictureOptions& options) {
  auto painter = Painter::open();
  if (!painter) return painter.failure();
  return painter->draw(mesh, options);
}

Result<Image> drawPlant(const simeco::Plant& plant, const PictureOptions& options) {
  const auto mesh = meshOf(plant);
  if (!mesh) return mesh.failure();
  return drawPlant(*mesh, options);
}

Result<std::string> pngBytes(const Image& image) {
  try {
    cv::Mat bgr;
    const cv::Mat rgb(image.height_px, image.width_px, CV_8UC3, const_cast<std::uint8_t*>(image.rgb.data()));
    cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
    std::vector<std::uint8_t> bytes;
    if (cv::imencode(".png", bgr, bytes, {cv::IMWRITE_PNG_COMPRESSION, 3})) return std::string(bytes.begin(), bytes.end());
  } catch (const cv::Exception&) {
  }
  return fail(ErrorCode::BadInput, "an image of " + std::to_string(image.width_px) + " x " + std::to_string(image.height_px) + " pixels cannot be written as PNG");
}

Result<void> writePng(const std::filesystem::path& path, const Image& image) {
  const auto bytes = pngBytes(image);
  if (!bytes) return bytes.failure();
  return writeFile(path, *bytes);
}

}  // namespace axil::render
