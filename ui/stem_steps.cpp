#include "ui/stem_steps.hpp"

#include "document/lookup.hpp"

namespace axil::ui {
namespace {

using document::NodeId;
using document::Project;
using document::StemId;
using document::Step;

const skeleton3d::ClickedStem* stemWith(const Project& project, std::optional<StemId> id) {
  const auto place = id ? document::stemWithId(project, *id) : std::nullopt;
  return place ? &project.stems[*place].stem : nullptr;
}

/// What document would refuse is not offered.
std::optional<Step> ifPossible(const Project& project, Step step) {
  return document::apply(project, step) ? std::optional(std::move(step)) : std::nullopt;
}

}  // namespace

std::optional<Step> splitAt(const Project& project, NodeId node) {
  const auto* stem = stemWith(project, stemOf(project, node));
  if (stem == nullptr || stem->nodes.size() < 3 || stem->nodes.front() == node || stem->nodes.back() == node) return std::nullopt;
  return ifPossible(project, {document::SplitStem{stem->id, node, document::nextStemId(project)}});
}

std::optional<Step> reverseAt(const Project& project, NodeId node) {
  const auto* stem = stemWith(project, stemOf(project, node));
  if (stem == nullptr || stem->nodes.size() < 2) return std::nullopt;
  return ifPossible(project, {document::ReverseStem{stem->id}});
}

std::optional<Step> joinOnto(const Project& project, StemId upper, NodeId node) {
  const auto lower = stemOf(project, node);
  if (!lower || *lower == upper) return std::nullopt;
  return ifPossible(project, {document::JoinStems{*lower, upper}});
}

std::optional<Step> attachTo(const Project& project, StemId stem, NodeId node) { return ifPossible(project, {document::AttachStem{stem, node}}); }

}  // namespace axil::ui
