#include "ui/clicking.hpp"

#include "document/command_text.hpp"
#include "document/replay.hpp"

#include <gtest/gtest.h>

namespace axil::ui {
namespace {

using document::NodeId;
using document::Project;
using document::StemId;

Project projectOf(std::string_view lines) {
  const auto history = document::replay(Project{}, lines);
  EXPECT_TRUE(history) << history.error().message;
  return history ? history->project() : Project{};
}

const char* kViews = "add_view front \"\"\nadd_view right \"\"\n";

PhotoClick at(const char* view, double x, double y) { return {.view = view, .at = {{x, y}}, .reach_px = 8}; }

std::string printed(const ClickMeaning& meaning) { return document::print(meaning.step); }

TEST(Clicking, TheFirstClickBeginsTheFirstStem) {
  const auto meaning = meaningOf(projectOf(kViews), {}, at("front", 100, 200));
  EXPECT_EQ(meaning.kind, ClickKind::Begin);
  EXPECT_EQ(printed(meaning), "add_node 1 front 100 200 ; add_stem 1 1");
  EXPECT_EQ(meaning.after.node, NodeId(1));
}

TEST(Clicking, ASelectedTipGoesOn) {
  const Project project = projectOf(std::string(kViews) + "add_node 1 front 100 200 ; add_stem 1 1\n");
  const auto meaning = meaningOf(project, {NodeId(1)}, at("front", 100, 150));
  EXPECT_EQ(meaning.kind, ClickKind::Extend);
  EXPECT_EQ(printed(meaning), "add_node 2 front 100 150 ; append_node 1 2");
}

TEST(Clicking, ANodeWithoutAClickInThisPhotoGetsOne) {
  const Project project = projectOf(std::string(kViews) + "add_node 1 front 100 200 ; add_stem 1 1\nadd_node 2 front 100 150 ; append_node 1 2\n");
  const auto meaning = meaningOf(project, {NodeId(1)}, at("right", 50, 60));
  EXPECT_EQ(meaning.kind, ClickKind::Place);
  EXPECT_EQ(printed(meaning), "add_click 1 right 50 60");
  EXPECT_EQ(meaning.after.node, NodeId(2)) << "the next node of the stem that lacks a click here";
}

TEST(Clicking, ANodeInTheMiddleBranches) {
  const Project project = projectOf(std::string(kViews) + "add_node 1 front 0 0 ; add_stem 1 1\nadd_node 2 front 0 50 ; append_node 1 2\nadd_node 3 front 0 99 ; append_node 1 3\n");
  const auto meaning = meaningOf(project, {NodeId(2)}, at("front", 60, 60));
  EXPECT_EQ(meaning.kind, ClickKind::Branch);
  EXPECT_EQ(printed(meaning), "add_node 4 front 60 60 ; start_branch 2 2 ; append_node 2 4");
}

TEST(Clicking, AStemIsClickedAnewInAnotherPhotoFromAnyOfItsNodes) {
  const Project project = projectOf(std::string(kViews) + "add_node 1 front 0 0 ; add_stem 1 1\nadd_click 1 right 7 0\nadd_node 2 front 0 50 ; append_node 1 2\nadd_node 3 front 0 99 ; append_node 1 3\n");
  const auto meaning = meaningOf(project, {NodeId(1)}, at("right", 9, 52));
  EXPECT_EQ(meaning.kind, ClickKind::Place) << "the base is clicked here already; the next node is not";
  EXPECT_EQ(printed(meaning), "add_click 2 right 9 52");
  EXPECT_EQ(meaning.after.node, NodeId(3));
  PhotoClick again = at("right", 7.5, 0.5);
  again.picking = Picking::OnlyPlace;
  EXPECT_EQ(meaningOf(project, {NodeId(1)}, again).kind, ClickKind::Select) << "the base itself, once more";
  EXPECT_EQ(meaningOf(project, {NodeId(1)}, at("front", 50, 10)).kind, ClickKind::Branch) << "here all of it is clicked";
}

TEST(Clicking, AStemThatBowsAwayFromItsStraightLineIsHitWhereItIsSeen) {
  const Project project = projectOf(std::string(kViews) + "add_node 1 front 100 1400 ; add_stem 1 1\nadd_node 2 front 100 600 ; append_node 1 2\nadd_click 2 right 100 600\n");
  PhotoClick beside = at("front", 116, 1000);
  beside.photo_px = 1600;
  EXPECT_EQ(meaningOf(project, {NodeId(2)}, beside).kind, ClickKind::Extend) << "no stem is seen there";
  beside.stem_px = 5;
  EXPECT_EQ(printed(meaningOf(project, {NodeId(2)}, beside)), "add_node 3 front 116 1000 ; insert_node 1 3 2");
  beside.at.px.x = 160;
  EXPECT_EQ(meaningOf(project, {NodeId(2)}, beside).kind, ClickKind::Extend) << "no stem of this line";
}

TEST(Clicking, OnAStemsLineItGetsANodeToBranchFrom) {
  const Project project = projectOf(std::string(kViews) + "add_node 1 front 0 0 ; add_stem 1 1\nadd_node 2 front 0 50 ; append_node 1 2\nadd_node 3 front 60 60 ; start_branch 2 2 ; append_node 2 3\n" +
                                     "add_node 4 front 0 99 ; append_node 1 4\nadd_click 3 right 60 60\n");
  const auto meaning = meaningOf(project, {NodeId(3)}, at("front", 3, 25));
  EXPECT_EQ(meaning.kind, ClickKind::Insert);
  EXPECT_EQ(printed(meaning), "add_node 5 front 3 25 ; insert_node 1 5 2");
  EXPECT_EQ(meaning.after.node, NodeId(5));
  EXPECT_EQ(meaningOf(project, {}, at("front", 3, 25)).kind, ClickKind::Insert) << "with nothing selected too";
  EXPECT_EQ(meaningOf(project, {NodeId(3)}, at("front", 5, 25)).kind, ClickKind::Extend) << "half the reach of a node";
  PhotoClick past = at("front", 3, 25);
  past.picking = Picking::OnlyPlace;
  EXPECT_EQ(meaningOf(project, {NodeId(3)}, past).kind, ClickKind::Extend) << "a stem can be crossed";
  EXPECT_EQ(meaningOf(project, {NodeId(4)}, at("front", 3, 25)).kind, ClickKind::Extend) << "a stem in the making goes on";
  EXPECT_EQ(meaningOf(project, {NodeId(2)}, at("front", 50, 58)).kind, ClickKind::Branch) << "a new branch may cross another";
  EXPECT_EQ(meaningOf(project, {NodeId(2)}, at("front", 3, 75)).kind, ClickKind::Branch) << "and stand before its own stem";
  EXPECT_EQ(meaningOf(project, {NodeId(1)}, at("right", 3, 25)).kind, ClickKind::Place) << "a click that is missing comes first";
}

TEST(Clicking, OnANodeSelectsItUnlessOnlyPlacingIsWanted) {
  const Project project = projectOf(std::string(kViews) + "add_node 1 front 100 200 ; add_stem 1 1\n");
  EXPECT_EQ(meaningOf(project, {}, at("front", 104, 203)).kind, ClickKind::Select);
  EXPECT_EQ(meaningOf(project, {}, at("front", 110, 203)).kind, ClickKind::Nothing) << "out of reach, and no node is selected to grow from";
  PhotoClick close = at("front", 104, 203);
  close.picking = Picking::OnlyPlace;
  EXPECT_EQ(meaningOf(project, {NodeId(1)}, close).kind, ClickKind::Extend);
}

TEST(Clicking, AStemGoesOnAlongAWayWithANodeAtEachOfItsPlaces) {
  const Project project = projectOf(std::string(kViews) + "add_node 1 front 0 0 ; add_stem 1 1\nadd_node 2 front 0 50 ; append_node 1 2\nadd_node 3 front 0 99 ; append_node 1 3\n");
  const std::vector<PhotoPoint> way{{{10, 20}}, {{30, 40}}};
  const ClickMeaning meaning = meaningAlong(project, {.node = NodeId(2), .others = {}}, {.view = "front", .at = way.back(), .reach_px = 8, .picking = Picking::OnlyPlace}, way);
  EXPECT_EQ(meaning.kind, ClickKind::Branch);
  EXPECT_EQ(printed(meaning), "add_node 4 front 10 20 ; start_branch 2 2 ; append_node 2 4 ; add_node 5 front 30 40 ; append_node 2 5");
  EXPECT_EQ(meaning.after.node, NodeId(5));
}

TEST(Clicking, WhatItMeansCanAlwaysBeDone) {
  Project project = projectOf(kViews);
  Selection selection;
  std::uint32_t random = 20051122;
  const auto next = [&](std::uint32_t below) { return (random = random * 1664525u + 1013904223u) / 65536u % below; };
  for (int i = 0; i < 600; ++i) {
    if (next(10) == 0 && !project.nodes.empty()) selection.node = project.nodes[next(static_cast<std::uint32_t>(project.nodes.size()))].node.id;
    const auto meaning = meaningOf(project, selection, at(next(2) == 0 ? "front" : "right", next(900), next(1200)));
    const auto after = document::apply(project, meaning.step);
    ASSERT_TRUE(after) << "click " << i << ": " << printed(meaning) << ": " << after.error().message;
    project = *after;
    if (meaning.kind != ClickKind::Nothing) selection = meaning.after;
  }
  EXPECT_GT(project.nodes.size(), 150u);
  EXPECT_GT(project.stems.size(), 10u);
}

}  // namespace
}  // namespace axil::ui
