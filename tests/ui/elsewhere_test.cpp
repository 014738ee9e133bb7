#include "ui/elsewhere.hpp"

#include "document/chain.hpp"
#include "document/lookup.hpp"
#include "document/project.hpp"

#include <gtest/gtest.h>

#include <filesystem>

namespace axil::ui {
namespace {

using document::NodeId;

const std::filesystem::path kFolder = std::filesystem::path(AXIL_SAMPLES_DIR) / "lantana";

/// Lantana without the clicks of some nodes in all photos but the front one.
document::Project withFrontAlone(std::initializer_list<int> nodes) {
  document::Project project = document::loadProject(kFolder / "lantana.axil").value().project;
  for (const int id : nodes) {
    const std::size_t at = *document::nodeWithId(project, NodeId(id));
    document::ProjectNode node = project.nodes[at];
    const PhotoPoint front = node.node.clicks.at("front");
    node.node.clicks.clear();
    node.node.clicks["front"] = front;
    project.nodes.set(at, node);
  }
  return project;
}

TEST(Elsewhere, AWaitingNodeOfAStemIsFoundWhereItsLineCrossesTheStem) {
  const document::Project whole = withFrontAlone({});
  const auto& trunk = whole.stems[0].stem.nodes;
  ASSERT_GE(trunk.size(), 5u);
  // Two in a row: the clicks to cross between are further along the stem.
  const document::Project project = withFrontAlone({trunk[2].value, trunk[3].value});
  const auto measured = document::measured({project, kFolder}, {});
  ASSERT_TRUE(measured) << measured.error().message;
  const auto found = placesOfWaiting(project, Placed{*measured});
  ASSERT_EQ(found.size(), 2u);
  for (const FoundPlace& place : found) {
    EXPECT_EQ(place.view, "right");
    const auto& clicked = whole.nodes[*document::nodeWithId(whole, place.node)].node.clicks.at("right");
    EXPECT_LT(glm::distance(place.at.px, clicked.px), 12) << place.node.value;  // the stem bends between its neighbours
  }
}

TEST(Elsewhere, TipsWaitForTheirClick) {
  const document::Project whole = withFrontAlone({});
  const document::Project project = withFrontAlone({whole.stems[1].stem.nodes.back().value});
  const auto measured = document::measured({project, kFolder}, {});
  ASSERT_TRUE(measured);
  EXPECT_TRUE(placesOfWaiting(project, Placed{*measured}).empty());
}

TEST(Elsewhere, WhatEstimatedCamerasPlaceIsAsFarOffAsTheirClicksMiss) {
  const document::Project project = withFrontAlone({withFrontAlone({}).stems[0].stem.nodes[2].value});
  auto measured = document::measured({project, kFolder}, {});
  ASSERT_TRUE(measured);
  ASSERT_EQ(placesOfWaiting(project, Placed{*measured}).size(), 1u);
  EXPECT_EQ(placesOfWaiting(project, Placed{*measured})[0].within_px, 0);
  for (const auto& [view, miss_px] : {std::pair{"front", 1.5}, {"right", 2.0}, {"top", 9.0}}) {
    measured->cameras.emplace_back();
    measured->cameras.back().view = view;
    measured->cameras.back().rms_px = miss_px;
  }
  EXPECT_EQ(placesOfWaiting(project, Placed{*measured})[0].within_px, 4);
}

}  // namespace
}  // namespace axil::ui
