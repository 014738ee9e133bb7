#include "ui/plant_picture.hpp"

#include "render/highlight.hpp"
#include "render/picture.hpp"
#include "skeleton3d/camera.hpp"

#include <chrono>
#include <cmath>
#include <memory>

namespace axil::ui {
namespace {

/// Which organs were not there yet when the plant was measured.
std::vector<bool> bornAfter(const simeco::Plant& plant, double time) {
  std::vector<bool> later(plant.organs.size());
  const double least = 1e-6 * std::max(1.0, time);
  for (std::size_t i = 0; i < later.size(); ++i) later[i] = plant.time - plant.organs[i].age > time + least;
  return later;
}

/// A cool blue beside all that is green and brown.
constexpr render::Highlight kPredicted{.colour = {0.10f, 0.28f, 0.85f}, .share = 0.55f};

/// A painter with the mesh it drew last, since a turning plant is one mesh.
class Draw {
 public:
  PlantPicture operator()(const PlantQuestion& question) {
    const auto begun = std::chrono::steady_clock::now();
    PlantPicture picture{.image = {}, .camera = question.camera, .size_px = question.size_px, .seconds = 0, .trouble = {}};
    auto image = draw(question);
    if (image) picture.image = std::move(*image);
    else picture.trouble = image.error();
    picture.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    return picture;
  }

 private:
  Result<render::Image> draw(const PlantQuestion& question) {
    if (!painter_) {
      auto painter = render::Painter::open();
      if (!painter) return painter.failure();
      painter_ = std::make_unique<render::Painter>(std::move(*painter));
    }
    if (auto meshed = mesh(question); !meshed) return meshed.failure();
    return painter_->draw(*mesh_, {.width_px = question.size_px.x, .height_px = question.size_px.y, .view = question.camera});
  }

  Result<void> mesh(const PlantQuestion& question) {
    if (mesh_ && grown_ && &grown_->data() == &question.growth.data() && time_ == question.time && measuredUntil_ == question.measuredUntil) return {};
    const auto plant = simeco::plantAt(question.growth, question.time);
    if (!plant) return plant.failure();
    auto made = render::meshOf(*plant);
    if (!made) return made.failure();
    if (question.measuredUntil && question.time > *question.measuredUntil) *made = render::highlighted(std::move(*made), bornAfter(*plant, *question.measuredUntil), kPredicted);
    mesh_ = std::make_unique<render::PlantMesh>(std::move(*made));
    grown_ = question.growth;
    time_ = question.time;
    measuredUntil_ = question.measuredUntil;
    return {};
  }

  std::unique_ptr<render::Painter> painter_;
  std::unique_ptr<render::PlantMesh> mesh_;
  std::optional<simeco::Growth> grown_;
  double time_ = -1;
  std::optional<double> measuredUntil_;
};

}  // namespace

PlantDrawer::Work drawingWork() {
  auto draw = std::make_shared<Draw>();
  return [draw](const PlantQuestion& question) { return (*draw)(question); };
}

skeleton3d::Camera orbitCamera(const Orbit& orbit, PlantPoint middle, double reach, glm::ivec2 size_px) {
  const double around = orbit.azimuth.radians(), up = orbit.elevation.radians();
  const glm::dvec3 towardsPlant{-std::sin(around) * std::cos(up), -std::sin(up), -std::cos(around) * std::cos(up)};
  const double focal = 2.4 * std::min(static_cast<double>(size_px.y), 1.5 * size_px.x);
  skeleton3d::Camera camera = skeleton3d::cameraAt(skeleton3d::rotationLookingAlong(PlantDirection::along(towardsPlant), PlantDirection::up()),
                                                   {.target = middle, .distance = 5.2 * reach / orbit.zoom, .focal_px = focal, .size_px = size_px});
  camera.centre_px += orbit.shift * static_cast<double>(size_px.y);
  return camera;
}

skeleton3d::Camera resized(skeleton3d::Camera camera, double factor) {
  camera.centre_px *= factor;
  if (camera.focal_px) *camera.focal_px *= factor;
  return camera;
}

}  // namespace axil::ui
