#include "document/chain.hpp"

#include <algorithm>

namespace axil::document {

namespace {

std::filesystem::path photoPath(const OpenProject& open, const ProjectView& view) {
  const std::filesystem::path photo(view.photo);
  return photo.is_absolute() ? photo : open.folder / photo;
}

std::string sizeText(glm::ivec2 size) { return std::to_string(size.x) + " x " + std::to_string(size.y); }

// The photo's own size, checked against what the project says of it; nothing where all is well.
std::string photoFault(const skeleton3d::View& view, glm::ivec2 photo) {
  if (view.size_px != glm::ivec2{0, 0} && view.size_px != photo)
    return "view '" + view.name + "': size_px says " + sizeText(view.size_px) + " px, but the photo has " + sizeText(photo) +
           " px; correct size_px or give the photo the camera was measured for";
  const glm::dvec2 centre = view.camera.centre_px;
  const bool outside = centre.x < 0 || centre.y < 0 || centre.x > photo.x || centre.y > photo.y;
  if (view.camera.model != skeleton3d::CameraModel::Unknown && outside)
    return "view '" + view.name + "': the camera's centre_px lies outside the photo of " + sizeText(photo) + " px; this camera belongs to another photo";
  return {};
}

}  // namespace

const char* nameOf(GrammarKind kind) {
  switch (kind) {
    case GrammarKind::Initial: return "initial";
    case GrammarKind::Predictive: return "predictive";
    case GrammarKind::Structured: return "structured";
  }
  return "initial";
}

Result<keywords::Presets> presetsOf(const Project& project) {
  if (project.description.empty()) return keywords::Presets{};
  const auto traits = keywords::readTraits(project.description);
  if (!traits) return traits.failure();
  return keywords::presetsOf(*traits);
}

Result<std::vector<skeleton3d::View>> viewsOf(const OpenProject& open) {
  std::vector<skeleton3d::View> views;
  std::vector<std::string> faults;
  for (const ProjectView& view : open.project.views) {
    views.push_back(view.view);
    if (view.photo.empty()) continue;
    const auto photo = skeleton3d::probePhoto(photoPath(open, view));
    const std::string fault = photo ? photoFault(view.view, {photo->width, photo->height}) : "view '" + view.view.name + "': " + photo.error().message;
    if (!fault.empty()) faults.push_back(fault);
    else views.back().size_px = {photo->width, photo->height};
  }
  if (faults.empty()) return views;
  if (faults.size() == 1) return fail(ErrorCode::BadInput, faults.front());
  return fail(Error{ErrorCode::BadInput, "the photos are not as the project says", std::move(faults)});
}

Result<skeleton3d::Skeleton> skeletonOf(const OpenProject& open, const ChainOptions& options) {
  const Project& project = open.project;
  auto views = viewsOf(open);
  if (!views) return views.failure();
  std::vector<skeleton3d::ClickedNode> nodes;
  std::vector<skeleton3d::ClickedStem> stems;
  for (const ProjectNode& node : project.nodes) nodes.push_back(node.node);
  for (const ProjectStem& stem : project.stems) stems.push_back(stem.stem);
  auto skeleton = skeleton3d::buildSkeleton(*views, nodes, stems, options.solve, project.unit);
  if (!skeleton || project.leaves.empty()) return skeleton;
  const auto presets = presetsOf(project);
  if (!presets) return presets.failure();
  std::vector<quantify::LeafArrangement> leaves;
  for (const ProjectLeaves& entry : project.leaves) leaves.push_back(entry.arrangement);
  return quantify::withLeaves(*skeleton, leaves, *presets);
}

Result<quantify::Measurements> measurementsOf(const skeleton3d::Skeleton& skeleton, const ChainOptions& options) {
  return quantify::measure(skeleton, {.turning = options.turning});
}

Result<quantify::Measurements> measurementsOf(const OpenProject& open, const ChainOptions& options) {
  const auto skeleton = skeletonOf(open, options);
  if (!skeleton) return skeleton.failure();
  return measurementsOf(*skeleton, options);
}

Result<simeco::Grammar> grammarOf(const Project& project, const quantify::Measurements& measurements, GrammarKind kind, const ChainOptions& options) {
  const emit::EmitOptions emitOptions{.name = project.name, .decimals = options.decimals, .turning = options.turning};
  switch (kind) {
    case GrammarKind::Initial: return emit::initialGrammar(measurements, emitOptions);
    case GrammarKind::Predictive: return emit::predictiveGrammar(measurements, emitOptions);
    case GrammarKind::Structured: return emit::structuredGrammar(measurements, emitOptions);
  }
  return emit::initialGrammar(measurements, emitOptions);
}

Result<simeco::Grammar> grammarOf(const OpenProject& open, GrammarKind kind, const ChainOptions& options) {
  const auto measurements = measurementsOf(open, options);
  if (!measurements) return measurements.failure();
  return grammarOf(open.project, *measurements, kind, options);
}

}  // namespace axil::document
