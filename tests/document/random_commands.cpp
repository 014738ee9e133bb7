#include "random_commands.hpp"

#include "document/lookup.hpp"

#include <bit>
#include <cmath>
#include <iterator>
#include <optional>

namespace axil::test {

using namespace document;
using quantify::LeafArrangement;
using skeleton3d::Camera;
using skeleton3d::CameraModel;

namespace {

// ---- values of any kind ----------------------------------------------------------------------------------------------

double anyNumber(Rng& rng) {
  if (rng.below(2) == 0) return std::round(rng.uniform(-2000, 2000) * 10) / 10;
  double number = std::bit_cast<double>(rng.bits());
  while (!std::isfinite(number)) number = std::bit_cast<double>(rng.bits());
  return number;
}
std::int32_t anyInt(Rng& rng) { return static_cast<std::int32_t>(rng.bits()); }
PhotoPoint anyPoint(Rng& rng) {
  const double x = anyNumber(rng);
  return {{x, anyNumber(rng)}};
}
CameraModel anyModel(Rng& rng) { return static_cast<CameraModel>(rng.below(3)); }

template <class AnId>
std::vector<AnId> anyIds(Rng& rng) {
  std::vector<AnId> ids;
  for (std::uint64_t n = 1 + rng.below(4); n > 0; --n) ids.emplace_back(anyInt(rng));
  return ids;
}

template <class Make>
auto maybe(Rng& rng, Make make) {
  using T = decltype(make());
  return rng.below(2) == 0 ? std::optional<T>() : std::optional<T>(make());
}

Angle anyAngle(Rng& rng) { return rng.below(2) == 0 ? Angle::fromDegrees(static_cast<double>(rng.below(360))) : Angle::fromRadians(anyNumber(rng)); }

LeafArrangement anyLeaves(Rng& rng) {
  LeafArrangement leaves;
  leaves.stem = StemId(anyInt(rng));
  if (rng.below(2) == 0) leaves.arrangement = anyText(rng);
  leaves.nodes = maybe(rng, [&] { return static_cast<int>(anyInt(rng)); });
  if (rng.below(2) == 0) leaves.at = anyIds<NodeId>(rng);
  leaves.angle = maybe(rng, [&] { return anyAngle(rng); });
  leaves.roll = maybe(rng, [&] { return anyAngle(rng); });
  leaves.azimuth = maybe(rng, [&] { return anyAngle(rng); });
  leaves.length = maybe(rng, [&] { return anyNumber(rng); });
  leaves.width = maybe(rng, [&] { return anyNumber(rng); });
  leaves.petiole = maybe(rng, [&] { return anyNumber(rng); });
  if (rng.below(2) == 0) leaves.shape = anyText(rng);
  return leaves;
}

Camera anyCamera(Rng& rng) {
  Camera camera;
  camera.model = anyModel(rng);
  camera.focal_px = maybe(rng, [&] { return anyPoint(rng).px; });
  camera.centre_px = anyPoint(rng).px;
  for (double& k : camera.distortion) k = rng.below(2) == 0 ? 0 : anyNumber(rng);
  camera.scale_px_per_unit = anyNumber(rng);
  if (rng.below(2) == 0)
    for (int i = 0; i < 9; ++i) camera.rotation[i / 3][i % 3] = anyNumber(rng);
  camera.translation = {anyNumber(rng), 0, anyNumber(rng)};
  return camera;
}

// One member at a time, so that the order of draws is the same with every compiler.
void fill(Rng& rng, std::string& text) { text = anyText(rng); }
void fill(Rng& rng, SharedText& text) { text = anyText(rng); }
void fill(Rng& rng, double& number) { number = anyNumber(rng); }
void fill(Rng& rng, int& number) { number = anyInt(rng); }
void fill(Rng& rng, std::uint64_t& number) { number = rng.bits(); }
void fill(Rng& rng, NodeId& id) { id = NodeId(anyInt(rng)); }
void fill(Rng& rng, StemId& id) { id = StemId(anyInt(rng)); }
void fill(Rng& rng, PhotoPoint& point) { point = anyPoint(rng); }
void fill(Rng& rng, CameraModel& model) { model = anyModel(rng); }
void fill(Rng& rng, Camera& camera) { camera = anyCamera(rng); }
void fill(Rng& rng, LeafArrangement& leaves) { leaves = anyLeaves(rng); }
void fill(Rng& rng, std::vector<NodeId>& ids) { ids = anyIds<NodeId>(rng); }
void fill(Rng& rng, std::vector<StemId>& ids) { ids = anyIds<StemId>(rng); }

template <class C, class... Ts>
Command filled(Rng& rng, Ts C::*... members) {
  C command;
  (fill(rng, command.*members), ...);
  return command;
}

using Make = Command (*)(Rng&);
const Make kMakers[] = {
    [](Rng& r) { return filled(r, &SetName::name); },
    [](Rng& r) { return filled(r, &SetDescription::text); },
    [](Rng& r) { return filled(r, &SetSeed::seed); },
    [](Rng& r) { return filled(r, &SetUnit::unit); },
    [](Rng& r) { return filled(r, &AcceptTrait::organ, &AcceptTrait::property, &AcceptTrait::words); },
    [](Rng& r) { return filled(r, &ChangeTrait::organ, &ChangeTrait::property, &ChangeTrait::words, &ChangeTrait::value); },
    [](Rng& r) {
      return filled(r, &ChangeTraitRange::organ, &ChangeTraitRange::property, &ChangeTraitRange::words, &ChangeTraitRange::low, &ChangeTraitRange::high,
                    &ChangeTraitRange::unit);
    },
    [](Rng& r) { return filled(r, &RejectTrait::organ, &RejectTrait::property, &RejectTrait::words); },
    [](Rng& r) { return filled(r, &ForgetTrait::organ, &ForgetTrait::property, &ForgetTrait::words); },
    [](Rng& r) { return filled(r, &AddView::view, &AddView::photo); },
    [](Rng& r) { return filled(r, &RemoveView::view); },
    [](Rng& r) { return filled(r, &RenameView::view, &RenameView::name); },
    [](Rng& r) { return filled(r, &SwapViews::view, &SwapViews::other); },
    [](Rng& r) { return filled(r, &RelinkPhoto::view, &RelinkPhoto::photo); },
    [](Rng& r) { return filled(r, &SetPhotoSize::view, &SetPhotoSize::width, &SetPhotoSize::height); },
    [](Rng& r) { return filled(r, &SetCamera::view, &SetCamera::camera); },
    [](Rng& r) { return filled(r, &SetCameraModel::view, &SetCameraModel::model); },
    [](Rng& r) { return filled(r, &SetFocal::view, &SetFocal::fx_px, &SetFocal::fy_px); },
    [](Rng& r) { return filled(r, &ClearFocal::view); },
    [](Rng& r) { return filled(r, &SetOrigin::view, &SetOrigin::at); },
    [](Rng& r) { return filled(r, &ClearOrigin::view); },
    [](Rng& r) { return filled(r, &SetScale::view, &SetScale::from, &SetScale::to, &SetScale::length); },
    [](Rng& r) { return filled(r, &ClearScale::view); },
    [](Rng& r) { return filled(r, &AddNode::node, &AddNode::view, &AddNode::at); },
    [](Rng& r) { return filled(r, &RemoveNodes::nodes); },
    [](Rng& r) { return filled(r, &AddClick::node, &AddClick::view, &AddClick::at); },
    [](Rng& r) { return filled(r, &PlaceClick::node, &PlaceClick::view, &PlaceClick::at, &PlaceClick::within_px); },
    [](Rng& r) { return filled(r, &MoveClick::node, &MoveClick::view, &MoveClick::at); },
    [](Rng& r) { return filled(r, &RemoveClick::node, &RemoveClick::view); },
    [](Rng& r) { return filled(r, &SetRadius::node, &SetRadius::radius); },
    [](Rng& r) { return filled(r, &ClearRadius::node); },
    [](Rng& r) { return filled(r, &AddStem::stem, &AddStem::nodes); },
    [](Rng& r) { return filled(r, &StartBranch::stem, &StartBranch::at); },
    [](Rng& r) { return filled(r, &AppendNode::stem, &AppendNode::node); },
    [](Rng& r) { return filled(r, &InsertNode::stem, &InsertNode::node, &InsertNode::before); },
    [](Rng& r) { return filled(r, &RemoveFromStem::stem, &RemoveFromStem::node); },
    [](Rng& r) { return filled(r, &AttachStem::stem, &AttachStem::at); },
    [](Rng& r) { return filled(r, &SplitStem::stem, &SplitStem::at, &SplitStem::upper); },
    [](Rng& r) { return filled(r, &JoinStems::lower, &JoinStems::upper); },
    [](Rng& r) { return filled(r, &ReverseStem::stem); },
    [](Rng& r) { return filled(r, &RemoveStem::stem); },
    [](Rng& r) { return filled(r, &AddLeaves::leaves); },
    [](Rng& r) { return filled(r, &ChangeLeaves::number, &ChangeLeaves::leaves); },
    [](Rng& r) { return filled(r, &RemoveLeaves::number); },
    [](Rng& r) { return filled(r, &CopyLeaves::number, &CopyLeaves::stems); },
};
static_assert(std::size(kMakers) == std::variant_size_v<Command>);

// ---- values that are there -------------------------------------------------------------------------------------------

constexpr std::size_t kMostNodes = 60, kMostStems = 20, kMostLeaves = 20, kMostViews = 5;

/// Draws what is in the project, one time in twenty what may not be.
struct There {
  Rng& rng;
  const Project& project;

  bool odd() const { return rng.below(20) == 0; }
  std::string view() const {
    const char* const names[] = {"front", "right", "top", "back", "left"};
    if (odd() || project.views.empty()) return names[rng.below(5)];
    return project.views[rng.below(project.views.size())].view.name;
  }
  NodeId node() const {
    if (odd() || project.nodes.empty()) return NodeId(static_cast<std::int32_t>(rng.below(100)));
    return project.nodes[rng.below(project.nodes.size())].node.id;
  }
  StemId stem() const {
    if (odd() || project.stems.empty()) return StemId(static_cast<std::int32_t>(rng.below(30)));
    return project.stems[rng.below(project.stems.size())].stem.id;
  }
  NodeId nodeOf(StemId stem) const {
    const auto at = stemWithId(project, stem);
    if (odd() || !at || project.stems[*at].stem.nodes.empty()) return node();
    const auto& nodes = project.stems[*at].stem.nodes;
    return nodes[rng.below(nodes.size())];
  }
  /// A node that no stem passes through, where there is one.
  NodeId freeNode() const {
    for (int tries = 0; tries < 8; ++tries)
      if (const NodeId id = node(); !stemThrough(project, id)) return id;
    return node();
  }
  PhotoPoint point() const {
    const double x = std::round(rng.uniform(0, 1200) * 10) / 10;
    return {{x, std::round(rng.uniform(0, 1600) * 10) / 10}};
  }
  int leavesNumber() const { return static_cast<int>(rng.below(project.leaves.size() + 1)) + (odd() ? 1 : 0); }
  LeafArrangement leaves() const {
    LeafArrangement leaves;
    leaves.stem = stem();
    const char* const arrangements[] = {"", "alternate", "opposite", "decussate", "sideways"};
    leaves.arrangement = arrangements[rng.below(5)];
    if (rng.below(2) == 0) leaves.nodes = static_cast<int>(rng.below(12));
    else leaves.at.push_back(nodeOf(leaves.stem));
    if (rng.below(2) == 0) leaves.angle = Angle::fromDegrees(rng.uniform(0, 185));
    if (rng.below(2) == 0) leaves.length = rng.uniform(-0.01, 0.2);
    return leaves;
  }
};

template <class C>
Command with(const There& there, C command, NodeId C::*node, std::string C::*view, PhotoPoint C::*at) {
  command.*node = there.node();
  command.*view = there.view();
  command.*at = there.point();
  return command;
}

Command addSomething(const There& there) {
  const Project& p = there.project;
  switch (there.rng.below(5)) {
    case 0: {
      const std::string name = there.view();
      return AddView{p.views.size() < kMostViews || there.odd() ? "view" + std::to_string(there.rng.below(9)) : name, "a photo.jpg"};
    }
    case 1: return AddNode{nextNodeId(p), there.view(), there.point()};
    case 2: {
      const NodeId first = there.node();
      return AddStem{nextStemId(p), {first, there.freeNode()}};
    }
    case 3: return StartBranch{nextStemId(p), there.node()};
    default: return AddLeaves{there.leaves()};
  }
}

Command removeSomething(const There& there) {
  switch (there.rng.below(6)) {
    case 0: return RemoveView{there.view()};
    case 1: return RemoveNodes{{there.node()}};
    case 2: {
      const NodeId one = there.node();
      return RemoveNodes{{one, there.node()}};
    }
    case 3: {
      const StemId stem = there.stem();
      return RemoveFromStem{stem, there.nodeOf(stem)};
    }
    case 4: return RemoveStem{there.stem()};
    default: return RemoveLeaves{there.leavesNumber()};
  }
}

Command changeStem(const There& there) {
  const StemId stem = there.stem();
  switch (there.rng.below(7)) {
    case 0: return AppendNode{stem, there.freeNode()};
    case 1: {
      const NodeId node = there.freeNode();
      return InsertNode{stem, node, there.nodeOf(stem)};
    }
    case 2: return AttachStem{stem, there.node()};
    case 3: return SplitStem{stem, there.nodeOf(stem), nextStemId(there.project)};
    case 4: return JoinStems{stem, there.stem()};
    case 5: return ReverseStem{stem};
    default: return AppendNode{stem, there.freeNode()};
  }
}

/// With numbers for every model, though each uses only some.
Camera camera(Rng& rng) {
  Camera camera;
  camera.model = anyModel(rng);
  camera.focal_px = glm::dvec2{2778, 2777};
  camera.centre_px = {600, 800};
  camera.distortion = {1e-3, 0, 0, 0, 0};
  camera.scale_px_per_unit = 2000;
  camera.translation = {0, 0.4, 2};
  return camera;
}

Command changeView(const There& there) {
  const std::string view = there.view();
  switch (there.rng.below(12)) {
    case 0: return RenameView{view, there.view()};
    case 1: return SwapViews{view, there.view()};
    case 2: return RelinkPhoto{view, "elsewhere/" + view + ".jpg"};
    case 3: return SetPhotoSize{view, 1200, 1600};
    case 4: return SetCameraModel{view, anyModel(there.rng)};
    case 5: return SetFocal{view, there.rng.uniform(-10, 4000), 2778};
    case 6: return SetOrigin{view, there.point()};
    case 7: {
      const PhotoPoint from = there.point();
      return SetScale{view, from, there.point(), there.rng.uniform(-0.1, 1)};
    }
    case 8: return ClearScale{view};
    case 9: return ClearFocal{view};
    case 10: return SetCamera{view, camera(there.rng)};
    default: return ClearOrigin{view};
  }
}

Command changeClick(const There& there) {
  switch (there.rng.below(6)) {
    case 0: return with(there, AddClick(), &AddClick::node, &AddClick::view, &AddClick::at);
    case 1: {
      const NodeId node = there.node();
      const std::string view = there.view();
      const PhotoPoint at = there.point();
      return PlaceClick{node, view, at, there.rng.uniform(-0.5, 8)};
    }
    case 2: return with(there, MoveClick(), &MoveClick::node, &MoveClick::view, &MoveClick::at);
    case 3: {
      const NodeId node = there.node();
      return RemoveClick{node, there.view()};
    }
    case 4: return SetRadius{there.node(), there.rng.uniform(-0.001, 0.02)};
    default: return ClearRadius{there.node()};
  }
}

Command changeWords(const There& there) {
  const char* const words[] = {"ovate", "opposite", "3-8 cm", ""};
  const std::string said = words[there.rng.below(4)];
  switch (there.rng.below(7)) {
    case 0: return SetName{anyText(there.rng)};
    case 1: return SetDescription{"Leaves " + anyText(there.rng)};
    case 2: return AcceptTrait{"leaf", "shape", said};
    case 3: return ChangeTrait{"leaf", "shape", said, "lanceolate"};
    case 4: return ChangeTraitRange{"leaf", "length", said, there.rng.uniform(0, 5), 4, "cm"};
    case 5: return RejectTrait{"leaf", "shape", said};
    default: return ForgetTrait{"leaf", "shape", said};
  }
}

Command changeLeaves(const There& there) {
  const int number = there.leavesNumber();
  if (there.rng.below(2) == 0) return ChangeLeaves{number, there.leaves()};
  return CopyLeaves{number, {there.stem()}};
}

bool isFull(const Project& p) {
  return p.nodes.size() > kMostNodes || p.stems.size() > kMostStems || p.leaves.size() > kMostLeaves || p.views.size() > kMostViews;
}

ProjectView viewOfSize(const char* name) {
  ProjectView view;
  view.view.name = name;
  view.view.size_px = {1200, 1600};
  return view;
}

}  // namespace

std::string anyText(Rng& rng) {
  const char* const pieces[] = {"a", "Leaf", " ", "\"", "\\", "\n", "\t", ";", "=", "#", "葉", "\x01", "3.5", "-", ",", "é", "\xff"};
  std::string text;
  for (std::uint64_t n = rng.below(6); n > 0; --n) text += pieces[rng.below(std::size(pieces))];
  return text;
}

Command anyCommand(Rng& rng, std::size_t kind) { return kMakers[kind](rng); }

Command likelyCommand(Rng& rng, const Project& project) {
  const There there{rng, project};
  if (rng.below(50) == 0) return anyCommand(rng, rng.below(std::size(kMakers)));
  if (isFull(project)) return removeSomething(there);
  switch (rng.below(16)) {
    case 0: case 1: case 2: case 3: case 4: return addSomething(there);
    case 5: case 6: case 7: case 8: return changeClick(there);
    case 9: case 10: case 11: return changeStem(there);
    case 12: return changeView(there);
    case 13: return changeWords(there);
    case 14: return changeLeaves(there);
    default: return removeSomething(there);
  }
}

Project plantOf(int segments) {
  Project project;
  project.description = std::string(3000, 'x');
  for (const char* name : {"front", "right", "top"}) project.views.push_back(viewOfSize(name));
  Rng rng(7);
  const There there{rng, project};
  for (int n = 1; n <= segments + 1; ++n) {
    ProjectNode node;
    node.node.id = NodeId(n);
    for (const char* view : {"front", "right", "top"}) node.node.clicks[view] = there.point();
    node.node.radius = 0.004;
    project.nodes.push_back(node);
  }
  const int trunk = segments / 10;
  ProjectStem main;
  main.stem.id = StemId(1);
  for (int n = 1; n <= trunk + 1; ++n) main.stem.nodes.emplace_back(n);
  project.stems.push_back(main);
  for (int n = trunk + 2, base = 2; n <= segments + 1; n += 10, base = base % trunk + 1) {
    ProjectStem branch;
    branch.stem.id = StemId(static_cast<std::int32_t>(project.stems.size()) + 1);
    branch.stem.nodes.emplace_back(base);
    for (int k = n; k < n + 10 && k <= segments + 1; ++k) branch.stem.nodes.emplace_back(k);
    project.stems.push_back(branch);
  }
  for (const ProjectStem& stem : project.stems) {
    LeafArrangement leaves;
    leaves.stem = stem.stem.id;
    leaves.arrangement = "decussate";
    leaves.nodes = 4;
    project.leaves.push_back({leaves, {}});
  }
  return project;
}

}  // namespace axil::test
