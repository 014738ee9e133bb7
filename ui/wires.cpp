#include "ui/wires.hpp"

#include "document/lookup.hpp"
#include "ui/clicking.hpp"

#include <algorithm>

namespace axil::ui {
namespace {

constexpr std::size_t kMostReady = 3;
/// A way with less is no stem.
constexpr double kLeastConfidence = 0.4;
/// How far the line through the nodes may be from the stem, of the photo's longer side: few nodes count more than the last pixel.
constexpr double kTolerance = 0.0025;

/// Photos made ready, the last used first.
class Prepare {
 public:
  WireAnswer operator()(const WireQuestion& question) {
    WireAnswer answer{question, {}, {}};
    const skeleton3d::LiveWire* wire = ready(question.photo);
    if (wire == nullptr) return answer;
    answer.ready = *wire;
    if (!question.from) return answer;
    if (auto start = skeleton3d::startWire(*wire, *question.from, question.taken)) answer.start = std::move(*start);
    return answer;
  }

 private:
  const skeleton3d::LiveWire* ready(const std::shared_ptr<const skeleton3d::Photo>& photo) {
    const auto known = std::find_if(kept_.begin(), kept_.end(), [&](const auto& kept) { return kept.first == photo; });
    if (known != kept_.end()) {
      std::rotate(kept_.begin(), known, known + 1);
      return &kept_.front().second;
    }
    auto made = skeleton3d::prepareLiveWire(photo);
    if (!made) return nullptr;  // too small to hold a stem
    kept_.insert(kept_.begin(), {photo, std::move(*made)});
    if (kept_.size() > kMostReady) kept_.pop_back();
    return &kept_.front().second;
  }

  std::vector<std::pair<std::shared_ptr<const skeleton3d::Photo>, skeleton3d::LiveWire>> kept_;
};

}  // namespace

std::optional<document::NodeId> wireNode(const document::Project& project, const Selection& selection, const std::string& view) {
  if (!selection.node) return std::nullopt;
  if (document::clickOf(project, *selection.node, view) != nullptr) return selection.node;
  const auto stem = document::stemThrough(project, *selection.node);
  if (!stem) return std::nullopt;
  const auto& nodes = project.stems[*stem].stem.nodes;
  for (auto node = std::find(nodes.rbegin(), nodes.rend(), *selection.node); node != nodes.rend(); ++node)
    if (document::clickOf(project, *node, view) != nullptr) return *node;
  return std::nullopt;
}

Wires::Wires(std::function<void()> answered)
    : worker_([] { return [prepare = std::make_shared<Prepare>()](const WireQuestion& question) { return (*prepare)(question); }; }, std::move(answered)) {}

void Wires::ask(WireQuestion question) {
  if (!worker_.working()) worker_.ask(std::move(question));
}

void Wires::update(const document::OpenProject& open, const UiState& state, const Photos& photos) {
  if (auto answer = worker_.take()) {
    if (const auto known = place(answer->question.photo); known != ready_.end()) ready_.erase(known);
    ready_.push_back({answer->question.photo, answer->ready});
    if (ready_.size() > kMostReady) ready_.erase(ready_.begin());
    if (answer->start) answer_ = std::move(*answer);
  }
  if (!state.trace || state.way != Way::Stems) return;
  if (state.hover) {
    const auto at = document::viewNamed(open.project, state.hover->first);
    const auto node = at ? wireNode(open.project, state.selection, state.hover->first) : std::nullopt;
    const auto photo = at ? photos.photoOf(open, open.project.views[*at]) : nullptr;
    if (photo && node) {
      const PhotoPoint from = *document::clickOf(open.project, *node, state.hover->first);
      if (!answer_ || answer_->question.photo != photo || answer_->question.from != from) return ask({photo, from, segmentsIn(open.project, state.hover->first)});
    }
  }
  for (const document::ProjectView& view : open.project.views)
    if (const auto photo = photos.photoOf(open, view); photo && place(photo) == ready_.end() && ready_.size() < kMostReady) return ask({photo, {}, {}});
}

std::optional<skeleton3d::WirePath> Wires::way(const std::shared_ptr<const skeleton3d::Photo>& photo, PhotoPoint from, PhotoPoint to) const {
  if (!answer_ || answer_->question.photo != photo || answer_->question.from != from) return std::nullopt;
  const double side_px = std::max(photo->width, photo->height);
  const double tolerance_px = std::max({1.5, kTolerance * side_px, bowOf(glm::distance(from.px, to.px), side_px)});
  skeleton3d::WirePath path = skeleton3d::wireTo(*answer_->start, to, {.tolerance_px = tolerance_px});
  if (path.confidence < kLeastConfidence || path.nodes.size() < 2) return std::nullopt;
  return path;
}

std::vector<Wires::Ready>::const_iterator Wires::place(const std::shared_ptr<const skeleton3d::Photo>& photo) const {
  return std::find_if(ready_.begin(), ready_.end(), [&](const Ready& ready) { return ready.photo == photo; });
}

const skeleton3d::LiveWire* Wires::ready(const std::shared_ptr<const skeleton3d::Photo>& photo) const {
  const auto known = place(photo);
  return known == ready_.end() || !known->wire ? nullptr : &*known->wire;
}

}  // namespace axil::ui
