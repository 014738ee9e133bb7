#include "ui/grammar_links.hpp"

#include "base/source.hpp"
#include "document/lookup.hpp"
#include "skeleton3d/camera.hpp"

#include <algorithm>
#include <map>

namespace axil::ui {
namespace {

std::optional<int> stageOf(const simeco::Grammar& grammar, const simeco::Module& module) {
  if (module.letter != simeco::letterOf(simeco::OrganKind::Stem) || module.arguments.empty()) return std::nullopt;
  const auto* number = std::get_if<simeco::Number>(&grammar.at(module.arguments.front()).node);
  return number == nullptr ? std::nullopt : std::optional(static_cast<int>(number->value));
}

/// Lines of a text, and the line of each byte.
class Lines {
 public:
  explicit Lines(std::string_view text) {
    for (std::size_t at = 0; at < text.size(); ++at)
      if (text[at] == '\n') ends_.push_back(at);
    if (!text.empty() && text.back() != '\n') ends_.push_back(text.size());
  }
  [[nodiscard]] std::size_t count() const { return ends_.size(); }
  [[nodiscard]] std::size_t of(std::size_t byte) const {
    return static_cast<std::size_t>(std::lower_bound(ends_.begin(), ends_.end(), byte) - ends_.begin());
  }

 private:
  std::vector<std::size_t> ends_;
};

void mark(std::vector<int>& segments, const Lines& lines, SourceSpan where, int stage) {
  if (stage < stageOfSegment(0) || where.end <= where.begin) return;
  for (std::size_t line = lines.of(where.begin); line <= lines.of(where.end - 1) && line < segments.size(); ++line) segments[line] = stage - stageOfSegment(0);
}

}  // namespace

std::vector<int> segmentsOfLines(std::string_view text, const simeco::Grammar& grammar) {
  const Lines lines(text);
  std::vector<int> segments(lines.count(), -1);
  for (const simeco::PlantGrammar& plant : grammar.plants) {
    for (const simeco::OrganBlock& organ : plant.organs)
      if (organ.kind == simeco::OrganKind::Stem)
        for (const simeco::Stage& stage : organ.stages) {
          const std::uint32_t end = stage.attributes.empty() ? stage.where.end : std::max(stage.where.end, stage.attributes.back().where.end);
          mark(segments, lines, {stage.where.begin, end}, stage.number);
        }
    for (const simeco::Production& rule : plant.rules.productions)
      if (rule.predecessor.size() == 1)
        if (const auto stage = stageOf(grammar, rule.predecessor.front())) mark(segments, lines, rule.where, *stage);
  }
  return segments;
}

document::Step clicksFollowing(const document::Project& project, const document::Measured& measured, const skeleton3d::Skeleton& skeleton,
                               const quantify::Measurements& measurements, const simeco::Plant& plant) {
  std::map<int, PlantPoint> before;
  for (const skeleton3d::Node& node : skeleton.nodes) before[node.id.value] = node.position;
  double reach = 0;
  for (const auto& [id, at] : before) reach = std::max(reach, glm::length(at.at - measurements.origin.at));
  document::Step step;
  for (const simeco::Organ& organ : plant.organs) {
    if (organ.kind != simeco::OrganKind::Stem) continue;
    const int segment = plant.styleOf(organ).stage - stageOfSegment(0);
    if (segment < 0 || segment >= static_cast<int>(measurements.segments.size())) continue;
    const document::NodeId node = measurements.segments[static_cast<std::size_t>(segment)].to;
    const auto place = document::nodeWithId(project, node);
    const auto was = before.find(node.value);
    // What moves by less than the grammar's own rounding has not moved.
    if (!place || was == before.end() || glm::distance(was->second.at, organ.tip().at) < 1e-4 * reach) continue;
    for (const skeleton3d::View& view : measured.views) {
      const auto& clicks = project.nodes[*place].node.clicks;
      const auto click = clicks.find(view.name);
      if (click == clicks.end() || view.camera.model == skeleton3d::CameraModel::Unknown || !skeleton3d::isInFront(view.camera, organ.tip())) continue;
      const glm::dvec2 moved = skeleton3d::project(view.camera, organ.tip()).px - skeleton3d::project(view.camera, was->second).px;
      step.emplace_back(document::MoveClick{node, view.name, {click->second.px + moved}});
    }
  }
  return step;
}

}  // namespace axil::ui
