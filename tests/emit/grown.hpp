#pragma once
/// \file
/// What tests of this room share: a skeleton measured, written, grown; and its organs found again by their stage.

#include "emit/initial.hpp"
#include "emit/plan.hpp"
#include "quantify/measure.hpp"
#include "simeco/growth.hpp"
#include "simeco/language.hpp"
#include "support/known_plants.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <map>
#include <stdexcept>
#include <vector>

namespace axil::emit {

template <class T>
T valueOf(Result<T> result) {
  if (!result) throw std::runtime_error(result.error().message + (result.error().details.empty() ? "" : ": " + result.error().details.front()));
  return std::move(*result);
}

inline simeco::Plant grownUp(const simeco::Grammar& grammar, const simeco::GrowOptions& options = {}) {
  const simeco::Growth growth = valueOf(simeco::prepareGrowth(grammar, options));
  return valueOf(simeco::plantAt(growth, simeco::completeTime(growth)));
}

/// The grown organ of every segment, by the layout that initial.hpp describes.
inline std::vector<const simeco::Organ*> segmentOrgans(const simeco::Plant& plant, std::size_t segments) {
  std::vector<const simeco::Organ*> organs(segments, nullptr);
  for (const simeco::Organ& organ : plant.organs) {
    const int place = plant.styleOf(organ).stage - kFirstSegmentStage;
    if (organ.kind == simeco::OrganKind::Stem && place >= 0 && place < static_cast<int>(segments)) organs[static_cast<std::size_t>(place)] = &organ;
  }
  return organs;
}

/// The worst errors of a grown plant against its skeleton.
struct GrownErrors {
  double direction_deg = 0;
  double node = 0;             ///< distance, over the plant's height
  double leafDirection_deg = 0;
  double leafNormal_deg = 0;
  double leafBase = 0;         ///< distance, over the plant's height
  std::size_t leaves = 0;
};

inline GrownErrors errorsOf(const simeco::Plant& plant, const skeleton3d::Skeleton& skeleton, const quantify::Measurements& m) {
  std::map<skeleton3d::NodeId, glm::dvec3> truth;
  for (const skeleton3d::Node& node : skeleton.nodes) truth[node.id] = node.position.at;
  const double height = test::heightOf(skeleton);
  GrownErrors worst;
  const auto organs = segmentOrgans(plant, m.segments.size());
  for (std::size_t s = 0; s < organs.size(); ++s) {
    if (organs[s] == nullptr) throw std::runtime_error("segment " + std::to_string(s) + " did not grow");
    worst.direction_deg = std::max(worst.direction_deg, angleBetween(organs[s]->direction, m.segments[s].direction).degrees());
    worst.node = std::max(worst.node, glm::distance(organs[s]->tip().at, truth.at(m.segments[s].to)) / height);
    worst.node = std::max(worst.node, glm::distance(organs[s]->base.at, truth.at(m.segments[s].from)) / height);
  }
  // Leaves have no numbers of their own: each skeleton leaf must find a grown one that stands where it stands.
  std::vector<const simeco::Organ*> grown;
  for (const simeco::Organ& organ : plant.organs)
    if (organ.kind == simeco::OrganKind::Leaf) grown.push_back(&organ);
  worst.leaves = grown.size();
  for (const skeleton3d::Leaf& leaf : skeleton.leaves) {
    const auto off = [&](const simeco::Organ* organ) {
      return glm::distance(organ->base.at, leaf.position.at) + glm::distance(organ->direction.unit(), leaf.direction.unit());
    };
    const auto nearest = std::min_element(grown.begin(), grown.end(), [&](auto a, auto b) { return off(a) < off(b); });
    if (nearest == grown.end()) throw std::runtime_error("no leaf grew");
    worst.leafBase = std::max(worst.leafBase, glm::distance((*nearest)->base.at, leaf.position.at) / height);
    worst.leafDirection_deg = std::max(worst.leafDirection_deg, angleBetween((*nearest)->direction, leaf.direction).degrees());
    worst.leafNormal_deg = std::max(worst.leafNormal_deg, angleBetween((*nearest)->adaxial, leaf.normal).degrees());
  }
  return worst;
}

inline GrownErrors roundTrip(const skeleton3d::Skeleton& skeleton, const EmitOptions& options = {}) {
  const quantify::Measurements m = valueOf(quantify::measure(skeleton));
  return errorsOf(grownUp(valueOf(initialGrammar(m, options))), skeleton, m);
}

/// Everything that is wrong with a grammar's text, one line each; empty when it parses and checks without a word.
inline std::string complaints(const simeco::Grammar& grammar) {
  const std::string text = simeco::print(grammar);
  const simeco::Parsed parsed = simeco::parseSimeco(text);
  std::string all;
  for (const Diagnostic& d : parsed.diagnostics) all += formatDiagnostic(d, text, "grammar") + "\n";
  for (const Diagnostic& d : simeco::check(parsed.grammar)) all += formatDiagnostic(d, text, "grammar") + "\n";
  return all;
}

}  // namespace axil::emit
