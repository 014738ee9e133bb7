#include "ui/proposals.hpp"

#include "document/lookup.hpp"
#include "ui/clicking.hpp"

#include <algorithm>

namespace axil::ui {
namespace {

using document::NodeId;
using document::Project;

/// A way that is less sure than this is no proposal.
constexpr double kLeastConfidence = 0.25;  // where photos agree
constexpr double kSureAlone = 0.4;
constexpr double kLineStep_px = 4;
/// How far a new node is from every other one of its stem.
constexpr double kApartAlong_px = 24;
/// How far the line through the nodes may be from the stem, of the photo's longer side.
constexpr double kTolerance = 0.0025;
/// A way that runs this close to clicked stems for more than this share of it is one of them.
constexpr double kTaken_px = 5, kTakenShare = 0.5;
/// Tips of two photos' proposals are one place when they are no further apart than this share of the plant's reach.
constexpr double kApartOfReach = 0.06;

/// The nodes of the tip's stem from the last that is clicked in `view` up to the tip; empty where there is no such node before it.
std::vector<NodeId> openEnd(const Project& project, NodeId tip, const std::string& view) {
  const auto stem = document::stemThrough(project, tip);
  if (!stem || document::clickOf(project, tip, view) != nullptr) return {};
  const auto& nodes = project.stems[*stem].stem.nodes;
  const auto end = std::find(nodes.begin(), nodes.end(), tip);
  for (auto from = end; from != nodes.begin();)
    if (document::clickOf(project, *--from, view) != nullptr) return {from, end + 1};
  return {};
}

/// The view other than `view`, of known camera, in which all these nodes are clicked.
const skeleton3d::View* commonView(const Project& project, const Placed& placed, const std::vector<NodeId>& nodes, const std::string& view) {
  for (const document::ProjectView& candidate : project.views) {
    const std::string& name = candidate.view.name;
    if (name == view) continue;
    const bool inAll = std::all_of(nodes.begin(), nodes.end(), [&](NodeId node) { return document::clickOf(project, node, name) != nullptr; });
    if (const skeleton3d::View* known = inAll ? placed.view(name) : nullptr) return known;
  }
  return nullptr;
}

/// The way through the clicks of the first view.
skeleton3d::WirePath pathThrough(const std::vector<std::pair<NodeId, PhotoPoint>>& nodes) {
  skeleton3d::WirePath path;
  path.confidence = 1;
  for (const auto& [node, at] : nodes) path.nodes.push_back({at, 0, 1});
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
    const glm::dvec2 from = nodes[i].second.px, along = nodes[i + 1].second.px - from;
    const int steps = std::max(1, static_cast<int>(glm::length(along) / kLineStep_px));
    for (int k = 0; k < steps; ++k) path.line.push_back({{from + along * (static_cast<double>(k) / steps)}, 0, 1});
  }
  path.line.push_back(path.nodes.back());
  return path;
}

/// The place of the way, not before `from`, that is `click` in the first view: a way that crosses itself is followed in order.
std::size_t placeOf(const std::vector<skeleton3d::StemPlace>& line, std::size_t from, PhotoPoint click) {
  const auto nearest = std::min_element(line.begin() + static_cast<std::ptrdiff_t>(from), line.end(), [&](const auto& a, const auto& b) {
    return glm::distance(a.inFirst.px, click.px) < glm::distance(b.inFirst.px, click.px);
  });
  return static_cast<std::size_t>(nearest - line.begin());
}

bool isTaken(const std::vector<PhotoPoint>& line, const std::vector<std::pair<PhotoPoint, PhotoPoint>>& taken) {
  const auto near = std::count_if(line.begin(), line.end(), [&](PhotoPoint p) { return std::any_of(taken.begin(), taken.end(), [&](const auto& s) { return distanceToSegment(p.px, s.first.px, s.second.px) < kTaken_px; }); });
  return static_cast<double>(near) > kTakenShare * static_cast<double>(line.size());
}

/// The nodes of the way that lie between clicked ones, well apart from them: where it bends in the other photo alone.
std::vector<ProposedBend> bendsOf(const skeleton3d::StemBetween& between, const StemQuestion& question) {
  std::vector<ProposedBend> bends;
  std::size_t above = 1, place = placeOf(between.line, 0, question.nodes[1].second);
  for (const skeleton3d::StemPlace& node : between.nodes) {
    const std::size_t at = placeOf(between.line, 0, node.inFirst);
    while (above + 1 < question.nodes.size() && place <= at) ++above, place = placeOf(between.line, place, question.nodes[above].second);
    const auto isNear = [&](const auto& clicked) { return glm::distance(clicked.second.px, node.inFirst.px) < kApartAlong_px; };
    if (place > at && node.confidence >= kLeastConfidence && std::none_of(question.nodes.begin(), question.nodes.end(), isNear))
      bends.push_back({question.nodes[above].first, node.inFirst, node.inOther});
  }
  return bends;
}

void addClicks(const ProposedStem& stem, document::Step& step) {
  for (const auto& [node, at] : stem.clicks) step.emplace_back(document::PlaceClick{node, stem.view, at, stem.within_px});
  const auto& [tip, at] = stem.clicks.back();
  step.back() = document::AddClick{tip, stem.view, at};
}

void addBends(const Project& project, const ProposedStem& bent, document::Step& step) {
  const document::StemId stem = *stemOf(project, bent.clicks.back().first);
  NodeId added = document::nextNodeId(project);
  for (const ProposedBend& bend : bent.bends) {
    step.emplace_back(document::AddNode{added, bent.first, bend.inFirst});
    step.emplace_back(document::InsertNode{stem, added, bend.above});
    step.emplace_back(document::PlaceClick{added, bent.view, bend.inOther, bent.within_px});
    ++added.value;
  }
}

}  // namespace

const skeleton3d::View* Placed::view(const std::string& name) const {
  for (const skeleton3d::View& known : measured.views)
    if (known.name == name && known.camera.model != skeleton3d::CameraModel::Unknown) return &known;
  return nullptr;
}

const skeleton3d::Node* Placed::node(NodeId id) const {
  if (skeleton == nullptr) return nullptr;
  const auto found = std::find_if(skeleton->nodes.begin(), skeleton->nodes.end(), [&](const skeleton3d::Node& node) { return node.id == id; });
  return found == skeleton->nodes.end() ? nullptr : &*found;
}

double Placed::within_px(const std::string& from, const std::string& to) const {
  double miss_px = 0;
  for (const skeleton3d::CameraReport& report : measured.cameras)
    if (report.view == from || report.view == to) miss_px = std::max(miss_px, report.rms_px);
  return 2 * miss_px;
}

skeleton3d::Reach Placed::reach() const {
  std::vector<PlantPoint> places;
  if (skeleton != nullptr)
    for (const skeleton3d::Node& node : skeleton->nodes) places.push_back(node.position);
  return places.size() < 2 ? scene() : skeleton3d::reachOf(places, 1);
}

skeleton3d::Reach Placed::scene() const {
  double radius = 0;
  for (const skeleton3d::View& view : measured.views) {
    if (view.camera.model == skeleton3d::CameraModel::Unknown) continue;
    const glm::dvec2 size(view.size_px);
    for (const glm::dvec2 corner : {glm::dvec2(0, 0), {size.x, 0}, {0, size.y}, size}) {
      const skeleton3d::Ray ray = skeleton3d::rayThrough(view.camera, {corner});
      radius = std::max(radius, glm::length(glm::cross(ray.origin.at, ray.direction.unit())));
    }
  }
  return {{}, std::max(radius, 1e-9)};
}

std::optional<StemQuestion> stemQuestion(const Project& project, const Placed& placed, NodeId tip, const std::string& view, const skeleton3d::LiveWire& otherPhoto) {
  const std::vector<NodeId> nodes = openEnd(project, tip, view);
  const skeleton3d::View* other = placed.view(view);
  const skeleton3d::View* first = nodes.size() < 2 || other == nullptr ? nullptr : commonView(project, placed, nodes, view);
  if (first == nullptr) return std::nullopt;
  StemQuestion question{*first, *other, {}, otherPhoto, placed.reach(), {}, segmentsIn(project, view), placed.within_px(first->name, view)};
  for (const NodeId node : nodes) question.nodes.emplace_back(node, *document::clickOf(project, node, first->name));
  const double side_px = std::max(other->size_px.x, other->size_px.y);
  question.options.tolerance_px = std::max(kTolerance * side_px, bowOf(glm::distance(question.nodes.front().second.px, question.nodes.back().second.px), side_px));
  question.options.startInOther = *document::clickOf(project, nodes.front(), view);
  if (const skeleton3d::Node* base = placed.node(nodes.front())) question.options.base = base->position;
  return question;
}

std::optional<ProposedStem> proposedStem(const StemQuestion& question) {
  const auto between = skeleton3d::tracedInOtherView(question.first, pathThrough(question.nodes), question.other, question.otherPhoto, question.reach, question.options);
  if (!between || between->line.empty() || between->confidence < kLeastConfidence) return std::nullopt;
  ProposedStem proposed{question.other.name, {}, {}, between->line.back().at, between->confidence, question.within_px, question.first.name, bendsOf(*between, question)};
  std::size_t place = 0;
  for (std::size_t i = 1; i < question.nodes.size(); ++i) {
    place = placeOf(between->line, place, question.nodes[i].second);
    proposed.clicks.emplace_back(question.nodes[i].first, between->line[place].inOther);
  }
  if (question.options.endInOther) proposed.clicks.back().second = *question.options.endInOther;
  for (const skeleton3d::StemPlace& along : between->line) proposed.line.push_back(along.inOther);
  if (isTaken(proposed.line, question.taken) && !question.options.endInOther) return std::nullopt;
  return proposed;
}

std::vector<ProposedStem> agreeing(std::span<const StemQuestion> questions) {
  std::vector<ProposedStem> stems;
  for (const StemQuestion& question : questions)
    if (auto proposed = proposedStem(question)) stems.push_back(std::move(*proposed));
  std::stable_sort(stems.begin(), stems.end(), [](const ProposedStem& a, const ProposedStem& b) { return a.confidence > b.confidence; });
  if (stems.empty()) return stems;
  const double apart = kApartOfReach * questions.front().reach.radius;
  const PlantPoint tip = stems.front().tip;
  std::erase_if(stems, [&](const ProposedStem& stem) { return glm::distance(stem.tip.at, tip.at) > apart; });
  if (stems.size() == 1 && stems.front().confidence < kSureAlone) stems.clear();
  return stems;
}

document::Step stepOf(const Project& project, std::span<const ProposedStem> proposed) {
  document::Step step;
  for (const ProposedStem& stem : proposed) addClicks(stem, step);
  const auto bent = std::find_if(proposed.begin(), proposed.end(), [](const ProposedStem& stem) { return !stem.bends.empty(); });
  if (bent != proposed.end()) addBends(project, *bent, step);
  return step;
}

std::vector<skeleton3d::ProposedPlace> placesFor(const Placed& placed, const std::string& first, PhotoPoint click, const std::string& view, const skeleton3d::LiveWire& otherPhoto,
                                                 std::optional<NodeId> before) {
  const skeleton3d::View *here = placed.view(first), *there = placed.view(view);
  if (here == nullptr || there == nullptr) return {};
  skeleton3d::GuideExpectation expected;
  if (const skeleton3d::Node* known = before ? placed.node(*before) : nullptr) expected.before = known->position;
  auto places = skeleton3d::proposedPlaces(*here, click, *there, otherPhoto, placed.reach(), expected);
  return places ? std::move(*places) : std::vector<skeleton3d::ProposedPlace>{};
}

Proposals::Proposals(std::function<void()> answered)
    : worker_([] { return [](const std::vector<StemQuestion>& questions) { return agreeing(questions); }; }, std::move(answered)) {}

void Proposals::update(const document::OpenProject& open, std::uint64_t revision, const UiState& state, const std::optional<Placed>& placed, const Photos& photos, const Wires& wires) {
  if (auto answer = worker_.take()) stems_ = std::move(*answer);
  const bool isOn = state.trace && state.way == Way::Stems && state.selection.node && placed;
  if (asked_ != std::pair(revision, state.selection.node)) {
    stems_.clear();
    askedViews_.clear();
    asked_ = {revision, state.selection.node};
  }
  if (!isOn || worker_.working()) return;
  std::vector<StemQuestion> questions;
  std::vector<std::string> views;
  for (const document::ProjectView& view : open.project.views) {
    const auto photo = photos.photoOf(open, view);
    const skeleton3d::LiveWire* wire = photo ? wires.ready(photo) : nullptr;
    if (wire == nullptr) continue;
    if (auto stem = stemQuestion(open.project, *placed, *state.selection.node, view.view.name, *wire)) {
      questions.push_back(std::move(*stem));
      views.push_back(view.view.name);
    }
  }
  if (views == askedViews_) return;  // a photo that was made ready since asks anew
  askedViews_ = std::move(views);
  worker_.ask(std::move(questions));
}

const ProposedStem* Proposals::in(const std::string& view) const {
  const auto found = std::find_if(stems_.begin(), stems_.end(), [&](const ProposedStem& stem) { return stem.view == view; });
  return found == stems_.end() ? nullptr : &*found;
}

}  // namespace axil::ui
