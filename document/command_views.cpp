#include "base/text.hpp"
#include "document/command_parts.hpp"

#include <cmath>

namespace axil::document {

using skeleton3d::Camera;
using skeleton3d::CameraModel;

namespace {

constexpr std::size_t kMaximumPathBytes = 4096;
constexpr double kMaximumFocal_px = 1e8;
constexpr int kMaximumSize_px = 1'000'000;

/// The project with one view changed by `change`, which may refuse.
template <class Change>
Result<Project> withView(Project project, const std::string& name, Change change) {
  const auto at = placeOfView(project, name);
  if (!at) return at.failure();
  ProjectView view = project.views[*at];
  if (Result<void> changed = change(view); !changed) return changed.failure();
  project.views.set(*at, std::move(view));
  return project;
}

Result<void> checkNewName(const Project& project, const std::string& name) {
  if (auto checked = checkName("the view's name", name); !checked) return checked;
  if (viewNamed(project, name)) return fail(ErrorCode::BadInput, "there is a view " + inQuotes(name) + " already; choose another name or swap the two");
  return {};
}

Result<void> checkPhotoPath(const std::string& photo) {
  if (photo.size() > kMaximumPathBytes) return fail(ErrorCode::LimitReached, "the photo's path is longer than " + std::to_string(kMaximumPathBytes) + " bytes");
  if (!isUtf8(photo) || photo.find('\0') != std::string::npos) return fail(ErrorCode::BadInput, "the photo's path is not UTF-8 text; rename the file");
  return {};
}

/// Every node's clicks, and its marks of which are placed, go through `change`.
template <class Change>
void changeClicks(Project& project, Change change) {
  for (std::size_t i = 0; i < project.nodes.size(); ++i) {
    ProjectNode node = project.nodes[i];
    node.node.clicks = change(std::move(node.node.clicks));
    node.node.placed = change(std::move(node.node.placed));
    if (node.node != project.nodes[i].node) project.nodes.set(i, std::move(node));
  }
}

template <class Value>
using ByView = std::map<std::string, Value>;

template <class Value>
ByView<Value> withKey(ByView<Value> clicks, const std::string& from, const std::string& to) {
  auto entry = clicks.extract(from);
  if (entry.empty()) return clicks;
  entry.key() = to;
  clicks.erase(to);
  clicks.insert(std::move(entry));
  return clicks;
}

template <class Value>
ByView<Value> swapped(ByView<Value> clicks, const std::string& a, const std::string& b) {
  auto ofA = clicks.extract(a), ofB = clicks.extract(b);
  if (!ofA.empty()) {
    ofA.key() = b;
    clicks.insert(std::move(ofA));
  }
  if (!ofB.empty()) {
    ofB.key() = a;
    clicks.insert(std::move(ofB));
  }
  return clicks;
}

// ---- cameras ---------------------------------------------------------------------------------------------------------

// What the model does not use is neither saved nor compared.
Camera withoutUnused(Camera camera) {
  if (camera.model != CameraModel::Perspective) camera.distortion = {};
  if (camera.model != CameraModel::Orthographic) camera.scale_px_per_unit = 0;
  if (camera.model == CameraModel::Unknown) {
    camera.rotation = glm::dmat3(1.0);
    camera.translation = {0, 0, 0};
  }
  return camera;
}

Failure cannotBe(const ProjectView& view, const std::string& model, const std::string& why) {
  return fail(ErrorCode::BadInput, "the camera of " + inQuotes(view.view.name) + " cannot be " + model + ": " + why);
}

double pixelsOf(const skeleton3d::KnownLength& scale) { return glm::distance(scale.from.px, scale.to.px); }

// A photo taken exactly as the view's name says, from so far away that rays are parallel: origin and known length say the rest.
Result<Camera> nominalOrthographic(const ProjectView& view) {
  const auto rotation = skeleton3d::nominalRotation(view.view.name);
  if (!rotation) return cannotBe(view, "orthographic", "the name says no direction; call the view front, right or top, or give the whole camera");
  if (!view.origin_px || !view.scale) return cannotBe(view, "orthographic", "its place and scale are not known; set its origin and a known length first");
  Camera camera;
  camera.model = CameraModel::Orthographic;
  camera.focal_px = view.view.camera.focal_px;
  camera.centre_px = view.origin_px->px;
  camera.scale_px_per_unit = pixelsOf(*view.scale) / view.scale->length;
  camera.rotation = *rotation;
  return camera;
}

// Both models show what is as far away as the plant's origin at the same size: scale = focal / distance.
Result<Camera> asOrthographic(const ProjectView& view) {
  Camera camera = view.view.camera;
  if (camera.model == CameraModel::Unknown) return nominalOrthographic(view);
  if (camera.model == CameraModel::Orthographic) return camera;
  if (!camera.focal_px || camera.translation.z <= 0) return cannotBe(view, "orthographic", "the plant's origin is not in front of it");
  camera.model = CameraModel::Orthographic;
  camera.scale_px_per_unit = camera.focal_px->x / camera.translation.z;
  return camera;
}

Result<Camera> asPerspective(const ProjectView& view) {
  Camera camera = view.view.camera;
  if (camera.model == CameraModel::Perspective) return camera;
  if (camera.model == CameraModel::Unknown)
    return cannotBe(view, "perspective", "its pose is not known; leave it unknown and it is estimated, or give the whole camera");
  if (!camera.focal_px) return cannotBe(view, "perspective", "its focal length is not known; set it first");
  camera.model = CameraModel::Perspective;
  camera.translation.z = camera.focal_px->x / camera.scale_px_per_unit;
  return camera;
}

Result<Camera> asModel(const ProjectView& view, CameraModel model) {
  if (model == CameraModel::Orthographic) return asOrthographic(view);
  if (model == CameraModel::Perspective) return asPerspective(view);
  Camera camera = view.view.camera;
  camera.model = CameraModel::Unknown;
  return camera;
}

Result<void> setCamera(ProjectView& view, const Camera& given) {
  const Camera camera = withoutUnused(given);
  if (camera.model == CameraModel::Perspective && !camera.focal_px) return cannotBe(view, "perspective", "its focal length is not given");
  if (auto checked = skeleton3d::checkCamera(camera, view.view.name, view.view.size_px); !checked) return checked;
  view.view.camera = camera;
  return {};
}

}  // namespace

Result<std::size_t> placeOfView(const Project& project, std::string_view name) {
  if (const auto at = viewNamed(project, name)) return *at;
  std::string known;
  for (const ProjectView& view : project.views) known += (known.empty() ? "" : ", ") + view.view.name;
  return fail(ErrorCode::NotFound, "there is no view " + inQuotes(name) + (known.empty() ? "; add one first" : "; the views are " + known));
}

Result<void> checkPoint(const skeleton3d::View& view, PhotoPoint at) {
  for (const double coordinate : {at.px.x, at.px.y})
    if (auto checked = checkNumber("a coordinate", coordinate, -kMaximumPixel, kMaximumPixel); !checked) return checked;
  const bool inside = at.px.x >= 0 && at.px.y >= 0 && at.px.x <= view.size_px.x && at.px.y <= view.size_px.y;
  if (view.size_px == glm::ivec2{0, 0} || inside) return {};
  return fail(ErrorCode::BadInput, "(" + shortest(at.px.x) + ", " + shortest(at.px.y) + ") lies outside the photo of " + inQuotes(view.name) + ", which has " +
                                       std::to_string(view.size_px.x) + " x " + std::to_string(view.size_px.y) + " px");
}

Result<Project> after(Project project, const AddView& command) {
  if (auto checked = checkNewName(project, command.view); !checked) return checked.failure();
  if (auto checked = checkPhotoPath(command.photo); !checked) return checked.failure();
  if (project.views.size() >= kMaximumViews)
    return fail(ErrorCode::LimitReached, "a project has at most " + std::to_string(kMaximumViews) + " views");
  ProjectView view;
  view.view.name = command.view;
  view.photo = command.photo;
  project.views.push_back(std::move(view));
  return project;
}

Result<Project> after(Project project, const RemoveView& command) {
  const auto at = placeOfView(project, command.view);
  if (!at) return at.failure();
  project.views.erase(*at);
  changeClicks(project, [&](auto clicks) {
    clicks.erase(command.view);
    return clicks;
  });
  return project;
}

Result<Project> after(Project project, const RenameView& command) {
  const auto at = placeOfView(project, command.view);
  if (!at) return at.failure();
  if (command.view == command.name) return project;
  if (auto checked = checkNewName(project, command.name); !checked) return checked.failure();
  ProjectView view = project.views[*at];
  view.view.name = command.name;
  project.views.set(*at, std::move(view));
  changeClicks(project, [&](auto clicks) { return withKey(std::move(clicks), command.view, command.name); });
  return project;
}

Result<Project> after(Project project, const SwapViews& command) {
  const auto one = placeOfView(project, command.view);
  if (!one) return one.failure();
  const auto other = placeOfView(project, command.other);
  if (!other) return other.failure();
  ProjectView first = project.views[*other], second = project.views[*one];
  first.view.name = command.view;
  second.view.name = command.other;
  project.views.set(*one, std::move(first));
  project.views.set(*other, std::move(second));
  changeClicks(project, [&](auto clicks) { return swapped(std::move(clicks), command.view, command.other); });
  return project;
}

Result<Project> after(Project project, const RelinkPhoto& command) {
  if (auto checked = checkPhotoPath(command.photo); !checked) return checked.failure();
  return withView(std::move(project), command.view, [&](ProjectView& view) -> Result<void> {
    view.photo = command.photo;
    return {};
  });
}

Result<Project> after(Project project, const SetPhotoSize& command) {
  const auto allowed = [](int size) { return size >= 1 && size <= kMaximumSize_px; };
  if (!(command.width == 0 && command.height == 0) && !(allowed(command.width) && allowed(command.height)))
    return fail(ErrorCode::BadInput, "a photo's size must be from 1 x 1 to 1000000 x 1000000 px, or 0 x 0 for whatever it has");
  return withView(std::move(project), command.view, [&](ProjectView& view) -> Result<void> {
    view.view.size_px = {command.width, command.height};
    return {};
  });
}

Result<Project> after(Project project, const SetCamera& command) {
  return withView(std::move(project), command.view, [&](ProjectView& view) { return setCamera(view, command.camera); });
}

Result<Project> after(Project project, const SetCameraModel& command) {
  return withView(std::move(project), command.view, [&](ProjectView& view) -> Result<void> {
    const auto camera = asModel(view, command.model);
    if (!camera) return camera.failure();
    return setCamera(view, *camera);
  });
}

Result<Project> after(Project project, const SetFocal& command) {
  for (const double focal : {command.fx_px, command.fy_px})
    if (!(focal > 0) || focal > kMaximumFocal_px)
      return fail(ErrorCode::BadInput, "a focal length of " + shortest(focal) + " px is none; it must be above 0 and at most 1e8");
  return withView(std::move(project), command.view, [&](ProjectView& view) -> Result<void> {
    view.view.camera.focal_px = glm::dvec2{command.fx_px, command.fy_px};
    return {};
  });
}

Result<Project> after(Project project, const ClearFocal& command) {
  return withView(std::move(project), command.view, [&](ProjectView& view) -> Result<void> {
    if (view.view.camera.model == CameraModel::Perspective)
      return fail(ErrorCode::BadInput, "a perspective camera needs its focal length; make it unknown first");
    view.view.camera.focal_px.reset();
    return {};
  });
}

Result<Project> after(Project project, const SetOrigin& command) {
  return withView(std::move(project), command.view, [&](ProjectView& view) -> Result<void> {
    if (auto checked = checkPoint(view.view, command.at); !checked) return checked;
    view.origin_px = command.at;
    return {};
  });
}

Result<Project> after(Project project, const ClearOrigin& command) {
  return withView(std::move(project), command.view, [&](ProjectView& view) -> Result<void> {
    view.origin_px.reset();
    return {};
  });
}

Result<Project> after(Project project, const SetScale& command) {
  if (!std::isfinite(command.length) || command.length <= 0)
    return fail(ErrorCode::BadInput, "the known length is " + shortest(command.length) + "; it must be above zero");
  if (command.from == command.to) return fail(ErrorCode::BadInput, "both ends of the known length are one point; click its two ends");
  return withView(std::move(project), command.view, [&](ProjectView& view) -> Result<void> {
    for (const PhotoPoint at : {command.from, command.to})
      if (auto checked = checkPoint(view.view, at); !checked) return checked;
    view.scale = skeleton3d::KnownLength{command.from, command.to, command.length};
    return {};
  });
}

Result<Project> after(Project project, const ClearScale& command) {
  return withView(std::move(project), command.view, [&](ProjectView& view) -> Result<void> {
    view.scale.reset();
    return {};
  });
}

}  // namespace axil::document
