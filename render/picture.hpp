#pragma once
/// \file
/// Pictures: a plant in soft light on a light ground, drawn without any display. The same plant and options give the same
/// bytes every time.
///
/// A view is a preset, which fits the plant into the picture, or the exact camera of a photo: then every point of the
/// plant is where skeleton3d::project says, lens distortion and principal point included.

#include "base/result.hpp"
#include "render/daylight.hpp"
#include "render/plant_mesh.hpp"
#include "simeco/environment.hpp"
#include "skeleton3d/types.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

namespace axil::render {

/// Front, right and top look as the photos of these names do; ThreeQuarter from between front and right, a little above.
enum class ViewPreset { Front, Right, Top, ThreeQuarter };

/// A warm grey room without corners, or one even colour (linear).
struct StudioBackground {
  friend bool operator==(const StudioBackground&, const StudioBackground&) = default;
};
using Background = std::variant<StudioBackground, glm::vec3>;

/// Shadow: the plant stands on a floor that it shades, and what is below it is hidden. None: it stands nowhere.
enum class Ground { Shadow, None };

/// Quick: four samples a pixel. Fine: sixteen at the edges, for a picture that is looked at for long; half as slow again.
enum class Smoothing { Quick, Fine };

struct PictureOptions {
  int width_px = 1200;
  int height_px = 1600;
  std::variant<ViewPreset, skeleton3d::Camera> view = ViewPreset::ThreeQuarter;
  Background background = StudioBackground{};
  Ground ground = Ground::Shadow;
  std::optional<double> floorHeight = std::nullopt;  ///< none: floorUnder(mesh)
  Smoothing smoothing = Smoothing::Quick;
  std::vector<simeco::Obstacle> obstacles = {};  ///< drawn beside the plant, and shading it
};

/// Where the floor is: at the collar's height of a plant that stands on it; at the lowest point of one that hangs, creeps down or
/// shows its roots, which is one that reaches below its collar by more than a tenth of its extent.
[[nodiscard]] double floorUnder(const PlantMesh& mesh);

/// The largest picture: both sides together are kept to this many pixels.
inline constexpr std::int64_t maximumPixels = 100'000'000;

/// The camera that shows all of `mesh` from a preset's direction with a margin around it; one metre around the collar
/// where nothing has grown. With it one picture can be drawn like another, frame after frame.
[[nodiscard]] skeleton3d::Camera cameraFitting(const PlantMesh& mesh, ViewPreset preset, int width_px, int height_px);

/// Draws many pictures with one drawing context. One thread opens it and draws with it (see headless_window.hpp).
class Painter {
 public:
  /// Fails with NoAnswer where the machine cannot draw at all; the message says what to install.
  [[nodiscard]] static Result<Painter> open();
  Painter(Painter&&) noexcept;
  Painter& operator=(Painter&&) noexcept;
  ~Painter();

  /// Fails with BadInput for a size or camera that is none, with LimitReached above `maximumPixels`.
  [[nodiscard]] Result<Image> draw(const PlantMesh& mesh, const PictureOptions& options);

 private:
  struct Inside;
  explicit Painter(std::unique_ptr<Inside> inside);
  std::unique_ptr<Inside> inside_;
};

/// One picture, with a context of its own.
[[nodiscard]] Result<Image> drawPlant(const PlantMesh& mesh, const PictureOptions& options = {});
[[nodiscard]] Result<Image> drawPlant(const simeco::Plant& plant, const PictureOptions& options = {});

[[nodiscard]] Result<std::string> pngBytes(const Image& image);
/// Written aside, then renamed.
[[nodiscard]] Result<void> writePng(const std::filesystem::path& path, const Image& image);

}  // namespace axil::render
