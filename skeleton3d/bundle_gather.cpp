#include "skeleton3d/bundle.hpp"
#include "skeleton3d/camera.hpp"

#include <algorithm>
#include <cmath>

namespace axil::skeleton3d::detail {
namespace {

Result<void> checkHints(const BundleCamera& camera) {
  const auto& name = camera.view.name;
  const auto finite = [](glm::dvec2 p) { return std::isfinite(p.x) && std::isfinite(p.y); };
  if (camera.hints.origin_px && !finite(camera.hints.origin_px->px)) return viewFault(ErrorCode::BadInput, name, "its origin_px is not a number");
  if (!camera.hints.scale) return {};
  const KnownLength& scale = *camera.hints.scale;
  if (!finite(scale.from.px) || !finite(scale.to.px)) return viewFault(ErrorCode::BadInput, name, "an end of its known length is not a number");
  if (!(std::isfinite(scale.length) && scale.length > 0)) return viewFault(ErrorCode::BadInput, name, "its known length is not above zero");
  return {};
}

void guessFocal(BundleCamera& camera, const EstimateOptions& options) {
  const auto& given = camera.view.camera.focal_px;
  if (given) {
    camera.source = FocalSource::Given;
    camera.focal_px = given->x;
    camera.focalShare = options.givenFocalShare;
    camera.aspect = given->y / given->x;
  } else if (camera.hints.exif_focal_px && *camera.hints.exif_focal_px > 0) {
    camera.source = FocalSource::Exif;
    camera.focal_px = *camera.hints.exif_focal_px;
    camera.focalShare = options.exifFocalShare;
    camera.bend = options.unknownBend;
  } else {
    camera.focal_px = options.defaultFocalShareOfDiagonal * glm::length(glm::dvec2(camera.view.size_px));
    camera.focalShare = 1;
    camera.bend = options.unknownBend;
  }
}

Result<BundleCamera> unknownFrom(const View& view, const UnknownCameraHints& hints, const EstimateOptions& options) {
  BundleCamera camera;
  camera.known = view.camera.model != CameraModel::Unknown;
  camera.view = view;
  camera.hints = hints;
  if (const auto good = checkHints(camera); !good) return good.failure();
  if (camera.known) return camera;
  const auto nominal = nominalRotation(view.name);
  if (!nominal) return viewFault(ErrorCode::BadInput, view.name, "its name does not say where it looks; call it front, right, top, back or left");
  if (view.size_px.x <= 0 || view.size_px.y <= 0) return viewFault(ErrorCode::BadInput, view.name, "the size of its photo is unknown; give the photo or size_px");
  camera.nominal = *nominal;
  if (view.camera.centre_px == glm::dvec2{0, 0}) camera.view.camera.centre_px = glm::dvec2(view.size_px) / 2.0;
  guessFocal(camera, options);
  return camera;
}

std::vector<BundlePoint> pointsOf(const std::vector<BundleCamera>& cameras, std::span<const ClickedNode> nodes) {
  std::vector<BundlePoint> points;
  for (const ClickedNode& node : nodes) {
    BundlePoint point{node.id, {}, {}, false};
    for (std::size_t v = 0; v < cameras.size(); ++v)
      if (const auto click = node.clicks.find(cameras[v].view.name); click != node.clicks.end()) point.clicks.push_back({v, click->second.px});
    if (point.clicks.size() >= 2) points.push_back(std::move(point));
  }
  std::stable_sort(points.begin(), points.end(), [](const BundlePoint& a, const BundlePoint& b) { return a.id < b.id; });
  return points;
}

Result<void> checkEnough(const Bundle& bundle) {
  for (std::size_t v = 0; v < bundle.cameras.size(); ++v) {
    if (bundle.cameras[v].known) continue;
    const auto shared = static_cast<std::size_t>(std::count_if(bundle.points.begin(), bundle.points.end(), [&](const BundlePoint& p) {
      return std::any_of(p.clicks.begin(), p.clicks.end(), [&](const BundleClick& c) { return c.view == v; });
    }));
    if (shared < kFewestSharedNodes)
      return viewFault(ErrorCode::NoAnswer, bundle.cameras[v].view.name, "it shares " + std::to_string(shared) + " clicked nodes with other views; click at least " +
                                                                             std::to_string(kFewestSharedNodes));
  }
  const auto any = [&](auto has) { return std::any_of(bundle.cameras.begin(), bundle.cameras.end(), has); };
  if (!any([](const BundleCamera& c) { return c.known || c.hints.origin_px.has_value(); }))
    return fail(ErrorCode::NoAnswer, "the cameras cannot be estimated: the plant's origin is clicked in no view; click its collar in at least one");
  if (!any([](const BundleCamera& c) { return c.known || c.hints.scale.has_value(); }))
    return fail(ErrorCode::NoAnswer, "the cameras cannot be estimated: no length is known; click the two ends of something you measured in at least one view");
  return {};
}

}  // namespace

Failure viewFault(ErrorCode code, const std::string& name, const std::string& what) { return fail(code, "the camera of view '" + name + "' cannot be estimated: " + what); }

Failure doNotFit(const std::string& why) {
  return fail(ErrorCode::NoAnswer, "the views do not fit together" + why + "; check that front, right and top are not exchanged, no photo is mirrored, and the same points are clicked in each");
}

Result<Bundle> gatherBundle(std::span<const View> views, const std::map<std::string, UnknownCameraHints>& hints, std::span<const ClickedNode> nodes,
                        const EstimateOptions& options) {
  Bundle bundle;
  for (const View& view : views) {
    const auto hint = hints.find(view.name);
    auto camera = unknownFrom(view, hint == hints.end() ? UnknownCameraHints{} : hint->second, options);
    if (!camera) return camera.failure();
    bundle.scaleIsKnown = bundle.scaleIsKnown || camera->known;
    bundle.cameras.push_back(std::move(*camera));
  }
  std::sort(bundle.cameras.begin(), bundle.cameras.end(), [](const BundleCamera& a, const BundleCamera& b) { return a.view.name < b.view.name; });
  bundle.points = pointsOf(bundle.cameras, nodes);
  bundle.nodes = bundle.points.size();
  if (const auto enough = checkEnough(bundle); !enough) return enough.failure();
  return bundle;
}

}  // namespace axil::skeleton3d::detail
