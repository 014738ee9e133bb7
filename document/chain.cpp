#include "document/chain.hpp"

#include "base/units.hpp"
#include "document/traits.hpp"
#include "keywords/models.hpp"

#include <algorithm>
#include <map>

namespace axil::document {

namespace {

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

// Fills in the sizes of the photos; what the photos' own data say of the lens goes to `focals`, by view.
Result<std::vector<skeleton3d::View>> readViews(const OpenProject& open, const ChainOptions& options, std::map<std::string, double>& focals) {
  std::vector<skeleton3d::View> views;
  std::vector<std::string> faults;
  for (const ProjectView& view : open.project.views) {
    views.push_back(view.view);
    if (view.photo.empty()) continue;
    const auto photo = options.probePhoto(photoPath(open, view));
    const std::string fault = photo ? photoFault(view.view, {photo->width, photo->height}) : "view '" + view.view.name + "': " + photo.error().message;
    if (!fault.empty()) {
      faults.push_back(fault);
      continue;
    }
    views.back().size_px = {photo->width, photo->height};
    if (photo->exif_focal_px) focals[view.view.name] = *photo->exif_focal_px;
  }
  if (faults.empty()) return views;
  if (faults.size() == 1) return fail(ErrorCode::BadInput, faults.front());
  return fail(Error{ErrorCode::BadInput, "the photos are not as the project says", std::move(faults)});
}

std::vector<skeleton3d::ClickedNode> nodesOf(const Project& project) {
  std::vector<skeleton3d::ClickedNode> nodes;
  for (const ProjectNode& node : project.nodes) nodes.push_back(node.node);
  return nodes;
}

std::vector<skeleton3d::ClickedStem> stemsOf(const Project& project) {
  std::vector<skeleton3d::ClickedStem> stems;
  for (const ProjectStem& stem : project.stems) stems.push_back(stem.stem);
  return stems;
}

// The ends of a known length, as exactly as its photo shows them; as clicked where it cannot be read.
void readKnownLength(const OpenProject& open, const ProjectView& view, skeleton3d::UnknownCameraHints& hints) {
  if (!view.scale || view.photo.empty() || view.view.camera.model != skeleton3d::CameraModel::Unknown) return;
  const auto photo = skeleton3d::readPhoto(photoPath(open, view));
  if (!photo) return;
  const auto& given = view.view.camera.focal_px;
  const auto snapped = skeleton3d::snapKnownLength(*photo, *view.scale, given ? std::optional(given->x) : hints.exif_focal_px);
  hints.scale = snapped.scale;
  hints.scaleSigma_px = snapped.sigma_px;
}

std::map<std::string, skeleton3d::UnknownCameraHints> hintsOf(const OpenProject& open, const std::map<std::string, double>& focals) {
  std::map<std::string, skeleton3d::UnknownCameraHints> hints;
  for (const ProjectView& view : open.project.views) {
    const auto focal = focals.find(view.view.name);
    auto& own = hints[view.view.name] = {view.origin_px, view.scale, focal == focals.end() ? std::nullopt : std::optional(focal->second)};
    readKnownLength(open, view, own);
  }
  return hints;
}

Result<skeleton3d::Photos> photosOf(const OpenProject& open) {
  skeleton3d::Photos photos;
  for (const ProjectView& view : open.project.views) {
    if (view.photo.empty()) continue;
    auto photo = skeleton3d::readPhoto(photoPath(open, view));
    if (!photo) return photo.failure();
    photos[view.view.name] = *std::move(photo);
  }
  if (photos.empty()) return fail(ErrorCode::BadInput, "no view has a photo, so there is nothing that clicks could snap to; name the photos or measure without snapping");
  return photos;
}

bool anyUnknown(const std::vector<skeleton3d::View>& views) {
  return std::any_of(views.begin(), views.end(), [](const skeleton3d::View& view) { return view.camera.model == skeleton3d::CameraModel::Unknown; });
}

std::size_t nodesShared(std::span<const skeleton3d::ClickedNode> nodes, const std::string& view) {
  return static_cast<std::size_t>(std::count_if(nodes.begin(), nodes.end(), [&](const auto& node) {
    return node.clicks.size() - node.placed.size() > 1 && node.clicks.contains(view) && !node.placed.contains(view);
  }));
}

/// Whether the only known length or the only origin is in this view: then it is better asked for more clicks than left out.
bool holdsTheOnlyMark(const Project& project, const std::string& name) {
  const auto onlyIn = [&](auto has) {
    return std::count_if(project.views.begin(), project.views.end(), has) == 1 && std::find_if(project.views.begin(), project.views.end(), has)->view.name == name;
  };
  return onlyIn([](const ProjectView& view) { return view.scale.has_value(); }) || onlyIn([](const ProjectView& view) { return view.origin_px.has_value(); });
}

/// The view that is furthest from being estimated; a click that stands in it alone keeps it, so that its node is asked for elsewhere.
const skeleton3d::View* unusableView(const Measured& clicks, const Project& project) {
  const skeleton3d::View* worst = nullptr;
  std::size_t fewest = skeleton3d::kFewestSharedNodes;
  for (const skeleton3d::View& view : clicks.views) {
    const std::size_t shared = nodesShared(clicks.nodes, view.name);
    const bool alone = std::any_of(clicks.nodes.begin(), clicks.nodes.end(), [&](const auto& node) { return node.clicks.size() == 1 && node.clicks.contains(view.name); });
    if (view.camera.model == skeleton3d::CameraModel::Unknown && shared < fewest && !alone && !holdsTheOnlyMark(project, view.name)) worst = &view, fewest = shared;
  }
  return worst;
}

/// Two photos with enough clicks are a plant already; the third joins in when it has enough too.
Measured withoutUnusableViews(Measured clicks, const Project& project) {
  while (clicks.views.size() > 2) {
    const skeleton3d::View* view = unusableView(clicks, project);
    if (view == nullptr) break;
    clicks.notes.push_back("view '" + view->name + "' is left out: of the nodes clicked there " + std::to_string(nodesShared(clicks.nodes, view->name)) + " are clicked in other views too; click at least " +
                           std::to_string(skeleton3d::kFewestSharedNodes));
    for (skeleton3d::ClickedNode& node : clicks.nodes) node.clicks.erase(view->name), node.placed.erase(view->name);
    clicks.views.erase(clicks.views.begin() + (view - clicks.views.data()));
  }
  return clicks;
}

void takeCameras(skeleton3d::EstimatedCameras cameras, Measured& result) {
  result.nodes = skeleton3d::withoutSuspects(result.nodes, cameras.suspects);
  result.views = std::move(cameras.views);
  result.cameras = std::move(cameras.reports);
  result.suspects = std::move(cameras.suspects);
  result.uncertainty = std::move(cameras.uncertainty);
  result.notes.insert(result.notes.end(), std::make_move_iterator(cameras.notes.begin()), std::make_move_iterator(cameras.notes.end()));
}

void takeSnapping(skeleton3d::Snapping snapping, Measured& result) {
  std::size_t clicks = 0, snapped = 0;
  for (const auto& node : result.nodes) clicks += node.clicks.size();
  for (const auto& node : snapping.nodes) snapped += node.snappedIn.size();
  result.notes.push_back(std::to_string(snapped) + " of " + std::to_string(clicks) + " clicks were snapped to a stem's centre line; the others were kept as they are");
  for (const auto& node : snapping.nodes)
    for (auto& clicked : result.nodes)
      if (clicked.id == node.id && !clicked.radius) clicked.radius = node.radius;
  result.snapped = std::move(snapping.nodes);
}

/// Clicks alone. Where cameras are known, what is wrong with single clicks is for solving to say, node by node; views that are
/// read the wrong way are not.
Result<void> measureClicks(const OpenProject& open, const std::map<std::string, double>& focals, Measured& result) {
  auto cameras = skeleton3d::estimateCameras(result.views, hintsOf(open, focals), result.nodes, {.stems = stemsOf(open.project)});
  if (cameras)
    takeCameras(*std::move(cameras), result);
  else if (anyUnknown(result.views) || cameras.error().code == ErrorCode::NoAnswer)
    return cameras.failure();
  return {};
}

Result<void> measureSnapped(const OpenProject& open, const std::map<std::string, double>& focals, Measured& result) {
  const auto photos = photosOf(open);
  if (!photos) return photos.failure();
  auto found = skeleton3d::measurePhotographed(result.views, hintsOf(open, focals), *photos, result.nodes, {.stems = stemsOf(open.project)});
  if (!found) return found.failure();
  takeCameras(std::move(found->cameras), result);
  takeSnapping(std::move(found->snapping), result);
  return {};
}

/// Leaves wait with the stem or the nodes that they are on.
std::optional<quantify::LeafArrangement> onWhatIsPlaced(quantify::LeafArrangement leaves, const skeleton3d::Skeleton& skeleton) {
  if (std::find(skeleton.waiting.begin(), skeleton.waiting.end(), leaves.stem) != skeleton.waiting.end()) return std::nullopt;
  const bool atNodes = !leaves.at.empty();
  std::erase_if(leaves.at, [&](skeleton3d::NodeId id) {
    return std::any_of(skeleton.incomplete.begin(), skeleton.incomplete.end(), [&](const auto& node) { return node.id == id; });
  });
  return atNodes && leaves.at.empty() ? std::nullopt : std::optional(std::move(leaves));
}

emit::EmitOptions emitOptionsOf(const Project& project, const ChainOptions& options) {
  emit::EmitOptions emitOptions;
  emitOptions.name = project.name;
  emitOptions.decimals = options.decimals;
  emitOptions.turning = options.turning;
  if (const auto traits = traitsOf(project); traits && !traits->empty())
    if (const auto colours = keywords::leafColours(*traits); !colours.empty()) emitOptions.leafColour = colours.front();
  return emitOptions;
}

/// What the photos do not show and the description says: the flowers of what is still to grow.
Result<simeco::Grammar> inFlower(Result<simeco::Grammar> grammar, const Project& project, const quantify::Measurements& measurements) {
  const auto traits = traitsOf(project);
  if (!grammar || !traits) return grammar;
  const auto scale = emit::floweringScaleOf(measurements, metresPer(project.unit).value_or(1));
  return emit::withFlowers(*std::move(grammar), *traits, scale);
}

}  // namespace

std::filesystem::path photoPath(const OpenProject& open, const ProjectView& view) {
  const std::filesystem::path photo(view.photo);
  return photo.is_absolute() ? photo : open.folder / photo;
}

const char* nameOf(GrammarKind kind) {
  switch (kind) {
    case GrammarKind::Initial: return "initial";
    case GrammarKind::Predictive: return "predictive";
    case GrammarKind::Structured: return "structured";
  }
  return "initial";
}

Result<keywords::Presets> presetsOf(const Project& project) {
  const auto traits = traitsOf(project);
  if (!traits) return traits.failure();
  return keywords::presetsOf(*traits);
}

Result<Measured> measured(const OpenProject& open, const ChainOptions& options) {
  options.watch.report("reading the photos", 0);
  std::map<std::string, double> focals;
  auto views = readViews(open, options, focals);
  if (!views) return views.failure();
  Measured result = withoutUnusableViews({std::move(*views), nodesOf(open.project), {}, {}}, open.project);
  const bool snap = options.snap == Snap::On;
  options.watch.report(snap ? "looking for the stems in the photos" : anyUnknown(result.views) ? "estimating the cameras" : "judging the clicks", 0.2);
  const auto done = snap ? measureSnapped(open, focals, result) : measureClicks(open, focals, result);
  if (!done) return done.failure();
  return result;
}

Result<skeleton3d::Skeleton> skeletonOf(const Project& project, const Measured& clicks, const ChainOptions& options) {
  options.watch.report("solving the skeleton", 0.6);
  auto skeleton = skeleton3d::buildSkeleton(clicks.views, clicks.nodes, stemsOf(project), options.solve, project.unit);
  if (!skeleton) return skeleton;
  *skeleton = skeleton3d::withUncertainty(*std::move(skeleton), clicks.uncertainty);
  *skeleton = skeleton3d::withSnapped(*std::move(skeleton), clicks.views, clicks.nodes, clicks.snapped);
  if (project.leaves.empty()) return skeleton;
  const auto presets = presetsOf(project);
  if (!presets) return presets.failure();
  std::vector<quantify::LeafArrangement> leaves;
  for (const ProjectLeaves& entry : project.leaves)
    if (auto placed = onWhatIsPlaced(entry.arrangement, *skeleton)) leaves.push_back(std::move(*placed));
  return quantify::withLeaves(*skeleton, leaves, *presets);
}

Result<skeleton3d::Skeleton> skeletonOf(const OpenProject& open, const ChainOptions& options) {
  const auto clicks = measured(open, options);
  if (!clicks) return clicks.failure();
  return skeletonOf(open.project, *clicks, options);
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
  const emit::EmitOptions emitOptions = emitOptionsOf(project, options);
  switch (kind) {
    case GrammarKind::Initial: return emit::initialGrammar(measurements, emitOptions);
    case GrammarKind::Predictive: return inFlower(emit::predictiveGrammar(measurements, emitOptions, options.predictive), project, measurements);
    case GrammarKind::Structured: return inFlower(emit::structuredGrammar(measurements, emitOptions, options.structure), project, measurements);
  }
  return emit::initialGrammar(measurements, emitOptions);
}

Result<simeco::Grammar> grammarOf(const OpenProject& open, GrammarKind kind, const ChainOptions& options) {
  const auto measurements = measurementsOf(open, options);
  if (!measurements) return measurements.failure();
  return grammarOf(open.project, *measurements, kind, options);
}

}  // namespace axil::document
