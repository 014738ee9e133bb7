#include "document/command.hpp"

#include "document/lookup.hpp"
#include "document/replay.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace axil::document {
namespace {

using skeleton3d::CameraModel;

/// Stem 1 runs through nodes 1 2 3 4, stem 2 leaves it at 2 with 5 6, stem 3 leaves stem 2 at 5 with 7. Node 8 is free.
const char* const kPlant = R"(
set_name plant
add_view front front.jpg
add_view right right.jpg
add_node 1 front 600 1500 ; add_node 2 front 600 1200 ; add_node 3 front 610 900 ; add_node 4 front 620 600
add_node 5 front 700 1100 ; add_node 6 front 800 1000 ; add_node 7 front 750 900 ; add_node 8 front 100 100
add_stem 1 1 2 3 4
start_branch 2 2 ; append_node 2 5 ; append_node 2 6
add_stem 3 5 7
add_leaves 1 arrangement=opposite nodes=3
add_leaves 2 at=5,6 nodes=2 length=0.06
add_leaves 3 nodes=2
)";

Project plant() {
  const auto history = replay(Project(), kPlant);
  EXPECT_TRUE(history) << history.error().message;
  return history ? history->project() : Project();
}

Project afterLines(const std::string& lines) {
  const auto history = replay(plant(), lines);
  EXPECT_TRUE(history) << history.error().message;
  return history ? history->project() : plant();
}

/// Why the last of `lines` is refused, without the number of the line.
std::string refusalOf(const std::string& lines) {
  const auto history = replay(plant(), lines);
  if (history) return "not refused";
  const std::string& message = history.error().message;
  return message.substr(message.find("): ") + 3);
}

std::vector<int> nodesOf(const Project& project, int stem) {
  std::vector<int> ids;
  const auto at = stemWithId(project, StemId(stem));
  if (!at) return {};
  for (const NodeId id : project.stems[*at].stem.nodes) ids.push_back(id.value);
  return ids;
}

using Ids = std::vector<int>;

const ProjectView& view(const Project& project, const char* name) { return project.views[*viewNamed(project, name)]; }
const skeleton3d::ClickedNode& node(const Project& project, int id) { return project.nodes[*nodeWithId(project, NodeId(id))].node; }

// ---- the project -----------------------------------------------------------------------------------------------------

TEST(ProjectCommands, SetNameDescriptionSeedAndUnit) {
  const Project project = afterLines("set_name lantana\nset_description \"Shrub;\\nleaves opposite\"\nset_seed 7\nset_unit cm\n");
  EXPECT_EQ(project.name, "lantana");
  EXPECT_EQ(project.description.text(), "Shrub;\nleaves opposite");
  EXPECT_EQ(project.seed, 7u);
  EXPECT_EQ(project.unit, "cm");
}

TEST(ProjectCommands, RefuseWhatTheFileCouldNotHold) {
  EXPECT_EQ(refusalOf("set_name \"\""), "the plant's name must not be empty");
  EXPECT_EQ(refusalOf("set_name \"two\\nlines\""), "the plant's name must be one line without control characters");
  EXPECT_EQ(refusalOf("set_name \"\\xff\""), "the plant's name is not UTF-8 text");
  EXPECT_EQ(refusalOf("set_description \"\\xff\""), "the description is not UTF-8 text");
  EXPECT_EQ(refusalOf("set_seed 9007199254740993"), "the seed must be from 0 to 9007199254740992");
  const auto tooLong = document::apply(Project(), SetDescription{std::string(kMaximumDescriptionBytes + 1, 'x')});
  ASSERT_FALSE(tooLong);
  EXPECT_EQ(tooLong.error().code, ErrorCode::LimitReached);
}

TEST(TraitCommands, ADecisionIsKeptReplacedAndTakenBack) {
  EXPECT_EQ(afterLines("accept_trait leaf shape ovate").traits[0].verdict, Verdict::Accepted);
  const Project changed = afterLines("reject_trait leaf shape ovate\nchange_trait leaf shape ovate lanceolate\n");
  ASSERT_EQ(changed.traits.size(), 1u);
  EXPECT_EQ(changed.traits[0].verdict, Verdict::Changed);
  EXPECT_EQ(changed.traits[0].value, "lanceolate");
  const Project range = afterLines("change_trait_range leaf length \"3-8 cm\" 4 6 cm");
  EXPECT_EQ(range.traits[0].low, 4);
  EXPECT_EQ(range.traits[0].high, 6);
  EXPECT_TRUE(afterLines("reject_trait leaf shape ovate\nforget_trait leaf shape ovate\n").traits.empty());
}

TEST(TraitCommands, RefuseDecisionsAboutNothing) {
  EXPECT_EQ(refusalOf("accept_trait leaf shape \"\""), "only what the description says can be accepted; name its words");
  EXPECT_EQ(refusalOf("forget_trait leaf shape ovate"), "nothing was decided about leaf shape 'ovate'");
  EXPECT_EQ(refusalOf("change_trait leaf shape ovate \"\""), "the value must not be empty");
  EXPECT_EQ(refusalOf("change_trait_range leaf length x 8 3 cm"), "the range from 8 to 3 is none; give the smaller number first");
}

TEST(TraitCommands, DecisionsAreInTheProjectFile) {
  const Project project = afterLines("change_trait_range leaf length \"3-8 cm\" 4 6 cm\nreject_trait leaf shape ovate\nchange_trait leaf arrangement \"\" opposite\n");
  const auto again = parseProject(projectText(project));
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(*again, project);
}

// ---- views -----------------------------------------------------------------------------------------------------------

TEST(ViewCommands, AddAndRemoveWithItsClicks) {
  const Project added = afterLines("add_view top \"\"\nadd_click 2 top 5 5\n");
  EXPECT_EQ(added.views.size(), 3u);
  const Project removed = afterLines("add_click 2 right 5 5\nremove_view front\n");
  EXPECT_EQ(removed.views.size(), 1u);
  EXPECT_TRUE(node(removed, 1).clicks.empty());
  EXPECT_EQ(node(removed, 2).clicks.size(), 1u);
}

TEST(ViewCommands, ClicksFollowARenamedView) {
  const Project project = afterLines("rename_view front back");
  EXPECT_TRUE(node(project, 1).clicks.contains("back"));
  EXPECT_FALSE(node(project, 1).clicks.contains("front"));
  EXPECT_EQ(view(project, "back").photo, "front.jpg");
}

TEST(ViewCommands, SwappedViewsExchangeNamesAndNothingElse) {
  const Project project = afterLines("set_origin front 602 1490\nadd_click 2 right 5 6\nswap_views front right\n");
  EXPECT_EQ(project.views[0].view.name, "front");
  EXPECT_EQ(view(project, "front").photo, "right.jpg");
  EXPECT_EQ(view(project, "right").photo, "front.jpg");
  EXPECT_EQ(view(project, "right").origin_px, (PhotoPoint{{602, 1490}}));
  EXPECT_EQ(node(project, 2).clicks.at("front"), (PhotoPoint{{5, 6}}));
  EXPECT_EQ(node(project, 2).clicks.at("right"), (PhotoPoint{{600, 1200}}));
  EXPECT_EQ(node(project, 1).clicks.count("front"), 0u);
  EXPECT_EQ(afterLines("swap_views front right\nswap_views right front\n"), plant());
}

TEST(ViewCommands, ARelinkedPhotoKeepsClicksAndCamera) {
  const Project project = afterLines("relink_photo front /elsewhere/f.jpg");
  EXPECT_EQ(view(project, "front").photo, "/elsewhere/f.jpg");
  EXPECT_EQ(node(project, 1), node(plant(), 1));
}

TEST(ViewCommands, ASizeBoundsTheClicks) {
  EXPECT_EQ(refusalOf("set_photo_size front 1200 1600\nmove_click 1 front 1201 5\n"), "(1201, 5) lies outside the photo of 'front', which has 1200 x 1600 px");
  EXPECT_EQ(refusalOf("set_photo_size front 0 7"), "a photo's size must be from 1 x 1 to 1000000 x 1000000 px, or 0 x 0 for whatever it has");
  EXPECT_EQ(afterLines("set_photo_size front 1200 1600\nset_photo_size front 0 0\n"), plant());
}

TEST(ViewCommands, RefuseUnknownAndRepeatedNames) {
  EXPECT_EQ(refusalOf("add_view front x.jpg"), "there is a view 'front' already; choose another name or swap the two");
  EXPECT_EQ(refusalOf("rename_view front right"), "there is a view 'right' already; choose another name or swap the two");
  EXPECT_EQ(refusalOf("remove_view left"), "there is no view 'left'; the views are front, right");
  EXPECT_EQ(refusalOf("swap_views front left"), "there is no view 'left'; the views are front, right");
  EXPECT_EQ(refusalOf("relink_photo front \"\\xff.jpg\""), "the photo's path is not UTF-8 text; rename the file");
}

TEST(ViewCommands, SetAndClearOriginAndScale) {
  const Project project = afterLines("set_origin front 602 1490\nset_scale front 100 1500 100 900 0.3\n");
  EXPECT_EQ(view(project, "front").origin_px, (PhotoPoint{{602, 1490}}));
  EXPECT_EQ(view(project, "front").scale->length, 0.3);
  EXPECT_EQ(afterLines("set_origin front 602 1490\nset_scale front 1 2 3 4 5\nclear_origin front\nclear_scale front\n"), plant());
  EXPECT_EQ(refusalOf("set_scale front 1 2 1 2 5"), "both ends of the known length are one point; click its two ends");
  EXPECT_EQ(refusalOf("set_scale front 1 2 3 4 0"), "the known length is 0; it must be above zero");
  EXPECT_EQ(refusalOf("set_origin front 1e300 1"), "a coordinate is 1e+300; it must be from -1e+06 to 1e+06");
}

TEST(CameraCommands, AWholeCameraIsCheckedAndKeptAsTheFileHoldsIt) {
  const std::string good = "set_camera front model=perspective focal=2778,2778 centre=600,800 rotation=1,0,0,0,-1,0,0,0,-1 translation=0,0.4,2";
  const Project project = afterLines(good);
  EXPECT_EQ(view(project, "front").view.camera.model, CameraModel::Perspective);
  EXPECT_EQ(view(project, "front").view.camera.rotation[1][1], -1);
  EXPECT_EQ(*parseProject(projectText(project)), project);
  EXPECT_EQ(refusalOf("set_camera front model=perspective centre=600,800"), "the camera of 'front' cannot be perspective: its focal length is not given");
  EXPECT_NE(refusalOf("set_camera front model=orthographic scale=100 rotation=2,0,0,0,1,0,0,0,1"), "not refused");
  EXPECT_EQ(afterLines(good + "\nset_camera front model=unknown\n"), plant());
}

TEST(CameraCommands, OrthographicComesFromOriginAndKnownLength) {
  const Project project = afterLines("set_origin front 602 1490\nset_scale front 100 1500 100 900 0.3\nset_camera_model front orthographic\n");
  const skeleton3d::Camera& camera = view(project, "front").view.camera;
  EXPECT_DOUBLE_EQ(camera.scale_px_per_unit, 2000);
  EXPECT_EQ(skeleton3d::project(camera, PlantPoint{{0, 0, 0}}), (PhotoPoint{{602, 1490}}));
  EXPECT_EQ(skeleton3d::project(camera, PlantPoint{{0.1, 0.1, 0}}), (PhotoPoint{{802, 1290}}));
  EXPECT_EQ(refusalOf("set_camera_model front orthographic"),
            "the camera of 'front' cannot be orthographic: its place and scale are not known; set its origin and a known length first");
}

TEST(CameraCommands, ThePlantKeepsItsSizeBetweenTheModels) {
  const Project project = afterLines(
      "set_origin front 602 1490\nset_scale front 100 1500 100 900 0.3\nset_camera_model front orthographic\nset_focal front 3000 3000\n"
      "set_camera_model front perspective\n");
  const skeleton3d::Camera& camera = view(project, "front").view.camera;
  EXPECT_EQ(camera.model, CameraModel::Perspective);
  EXPECT_NEAR(skeleton3d::project(camera, PlantPoint{{0.1, 0, 0}}).px.x, 802, 1e-9);
  EXPECT_EQ(refusalOf("set_camera_model front perspective"),
            "the camera of 'front' cannot be perspective: its pose is not known; leave it unknown and it is estimated, or give the whole camera");
}

TEST(CameraCommands, FocalLengthIsSetAndCleared) {
  EXPECT_EQ(view(afterLines("set_focal front 2778 2777"), "front").view.camera.focal_px->y, 2777);
  EXPECT_EQ(afterLines("set_focal front 2778 2777\nclear_focal front\n"), plant());
  EXPECT_EQ(refusalOf("set_focal front 0 1"), "a focal length of 0 px is none; it must be above 0 and at most 1e8");
  EXPECT_EQ(refusalOf("set_camera front model=perspective focal=2778,2778 centre=600,800\nclear_focal front\n"),
            "a perspective camera needs its focal length; make it unknown first");
}

// ---- nodes and clicks ------------------------------------------------------------------------------------------------

TEST(NodeCommands, ClicksAreAddedMovedAndRemoved) {
  EXPECT_EQ(node(afterLines("add_click 1 right 5 6"), 1).clicks.at("right"), (PhotoPoint{{5, 6}}));
  EXPECT_EQ(node(afterLines("move_click 1 front 5 6"), 1).clicks.at("front"), (PhotoPoint{{5, 6}}));
  EXPECT_EQ(afterLines("add_click 1 right 5 6\nremove_click 1 right\n"), plant());
  EXPECT_EQ(refusalOf("add_click 1 front 5 6"), "node 1 has a click in 'front' already; move that one");
  EXPECT_EQ(refusalOf("move_click 1 right 5 6"), "node 1 has no click in 'right'; add one");
  EXPECT_EQ(refusalOf("remove_click 1 right"), "node 1 has no click in 'right'; add one");
  EXPECT_EQ(refusalOf("add_click 99 front 5 6"), "there is no node 99");
  EXPECT_EQ(refusalOf("add_click 1 left 5 6"), "there is no view 'left'; the views are front, right");
  EXPECT_FALSE(document::apply(plant(), MoveClick{NodeId(1), "front", {{std::numeric_limits<double>::quiet_NaN(), 0}}}));
}

TEST(NodeCommands, PlacedClicksAreMarkedUntilAPersonMovesThem) {
  using Placed = std::map<std::string, double>;
  const std::string place = "place_click 1 right 5 6 2\n";
  EXPECT_EQ(node(afterLines(place), 1).clicks.at("right"), (PhotoPoint{{5, 6}}));
  EXPECT_EQ(node(afterLines(place), 1).placed, (Placed{{"right", 2}}));
  EXPECT_EQ(node(afterLines(place + "move_click 1 right 5 6"), 1).placed, Placed{});
  EXPECT_EQ(afterLines(place + "remove_click 1 right"), plant());
  EXPECT_EQ(node(afterLines(place + "rename_view right side"), 1).placed, (Placed{{"side", 2}}));
  EXPECT_EQ(node(afterLines(place + "swap_views front right"), 1).placed, (Placed{{"front", 2}}));
  EXPECT_EQ(node(afterLines(place + "remove_view right"), 1).placed, Placed{});
  EXPECT_EQ(refusalOf("place_click 1 front 5 6 0"), "node 1 has a click in 'front' already; move that one");
  EXPECT_EQ(refusalOf("place_click 1 right 5 6 -1"), "how far off the click may be is -1; it must be from 0 to 1e+06");
}

TEST(NodeCommands, NewNodesNeedAnIdOfTheirOwn) {
  EXPECT_EQ(nextNodeId(plant()), NodeId(9));
  EXPECT_EQ(refusalOf("add_node 3 front 1 1"), "there is a node 3 already; the next free id is 9");
  EXPECT_EQ(refusalOf("add_node -1 front 1 1"), "a node's id must be 0 or above");
}

TEST(NodeCommands, RadiusIsSetAndCleared) {
  EXPECT_EQ(node(afterLines("set_radius 1 0.004"), 1).radius, 0.004);
  EXPECT_EQ(afterLines("set_radius 1 0.004\nclear_radius 1\n"), plant());
  EXPECT_EQ(refusalOf("set_radius 1 -1"), "the radius is -1; it must be from 0 to 1e+06");
}

TEST(NodeCommands, StemsCloseOverRemovedNodes) {
  EXPECT_EQ(nodesOf(afterLines("remove_nodes 3"), 1), (Ids{1, 2, 4}));
  EXPECT_EQ(nodesOf(afterLines("remove_nodes 4 3"), 1), (Ids{1, 2}));
  EXPECT_EQ(afterLines("remove_nodes 8").nodes.size(), 7u);
}

TEST(NodeCommands, ABranchThatLosesAllItsOwnNodesGoesWithItsLeaves) {
  const Project project = afterLines("remove_nodes 7");
  EXPECT_FALSE(stemWithId(project, StemId(3)));
  EXPECT_EQ(project.leaves.size(), 2u);
  EXPECT_TRUE(nodeWithId(project, NodeId(5)));
}

TEST(NodeCommands, ANodeThatCarriesARemainingStemStays) {
  EXPECT_EQ(refusalOf("remove_nodes 5"), "stem 3 begins at node 5; remove that stem or attach it elsewhere first");
  EXPECT_EQ(nodesOf(afterLines("remove_nodes 5 7"), 2), (Ids{2, 6}));
  EXPECT_EQ(afterLines("remove_nodes 1 2 3 4 5 6 7 8").stems.size(), 0u);
}

TEST(NodeCommands, LeavesAtRemovedNodesGoAndTheirCountFollows) {
  const Project project = afterLines("remove_nodes 6");
  EXPECT_EQ(project.leaves[1].arrangement.at, std::vector{NodeId(5)});
  EXPECT_EQ(project.leaves[1].arrangement.nodes, 1);
}

// ---- stems -----------------------------------------------------------------------------------------------------------

TEST(StemCommands, NodesAreAppendedAndInserted) {
  EXPECT_EQ(nodesOf(afterLines("append_node 1 8"), 1), (Ids{1, 2, 3, 4, 8}));
  EXPECT_EQ(nodesOf(afterLines("insert_node 1 8 3"), 1), (Ids{1, 2, 8, 3, 4}));
  EXPECT_EQ(nodesOf(afterLines("insert_node 1 8 1"), 1), (Ids{8, 1, 2, 3, 4}));
  EXPECT_EQ(refusalOf("insert_node 1 8 7"), "stem 1 has no node 7");
}

TEST(StemCommands, NothingThatCanNeverBeATreeIsLetIn) {
  EXPECT_EQ(refusalOf("append_node 1 6"), "node 6 belongs to stem 2 already; begin a branch there, or take another node");
  EXPECT_EQ(refusalOf("append_node 1 3"), "node 3 would be twice in stem 1; a stem never comes back to itself");
  EXPECT_EQ(refusalOf("add_stem 4 8 6"), "node 6 belongs to stem 2 already; begin a branch there, or take another node");
  EXPECT_EQ(refusalOf("append_node 3 1"), "stem 3 would grow out of itself; what begins at its nodes cannot also carry it");
  EXPECT_EQ(refusalOf("insert_node 2 8 2"), "node 2 belongs to stem 1 already; begin a branch there, or take another node");
  EXPECT_EQ(refusalOf("add_stem 3 8"), "there is a stem 3 already; the next free id is 4");
  EXPECT_EQ(refusalOf("add_stem 4 77"), "there is no node 77");
  EXPECT_EQ(refusalOf("start_branch 4 8"), "node 8 is on no stem, so nothing can branch there; add a stem instead");
}

TEST(StemCommands, ANodeTakenFromAStemStaysInTheProject) {
  const Project project = afterLines("remove_from_stem 1 3");
  EXPECT_EQ(nodesOf(project, 1), (Ids{1, 2, 4}));
  EXPECT_TRUE(nodeWithId(project, NodeId(3)));
  EXPECT_EQ(nodesOf(afterLines("remove_from_stem 2 2"), 2), (Ids{5, 6}));
  EXPECT_EQ(refusalOf("remove_from_stem 2 5"), "stem 3 begins at node 5; remove that stem or attach it elsewhere first");
  EXPECT_EQ(refusalOf("remove_from_stem 2 8"), "stem 2 has no node 8");
  EXPECT_FALSE(stemWithId(afterLines("remove_from_stem 3 7"), StemId(3)));
}

TEST(StemCommands, ABranchIsAttachedElsewhereAndAFreeStemForTheFirstTime) {
  EXPECT_EQ(nodesOf(afterLines("attach_stem 3 6"), 3), (Ids{6, 7}));
  EXPECT_EQ(nodesOf(afterLines("add_stem 4 8\nattach_stem 4 3\n"), 4), (Ids{3, 8}));
  EXPECT_EQ(refusalOf("attach_stem 2 7"), "stem 2 would grow out of itself; what begins at its nodes cannot also carry it");
}

TEST(StemCommands, SplitDividesNodesAndLeavesAndJoinUndoesIt) {
  const Project split = afterLines("add_leaves 1 at=2,4\nsplit_stem 1 3 9\n");
  EXPECT_EQ(nodesOf(split, 1), (Ids{1, 2, 3}));
  EXPECT_EQ(nodesOf(split, 9), (Ids{3, 4}));
  ASSERT_EQ(split.leaves.size(), 5u);
  EXPECT_EQ(split.leaves[0].arrangement.stem, StemId(1));
  EXPECT_EQ(split.leaves[3].arrangement.at, std::vector{NodeId(2)});
  EXPECT_EQ(split.leaves[4].arrangement.stem, StemId(9));
  EXPECT_EQ(split.leaves[4].arrangement.at, std::vector{NodeId(4)});
  EXPECT_EQ(afterLines("split_stem 1 3 9\njoin_stems 1 9\n"), plant());
  EXPECT_EQ(refusalOf("split_stem 1 4 9"), "node 4 is an end of stem 1; split it at a node in between");
  EXPECT_EQ(refusalOf("split_stem 1 3 2"), "there is a stem 2 already; the next free id is 4");
}

TEST(StemCommands, JoinGoesOnAtTheTipOrAcrossAGap) {
  EXPECT_EQ(nodesOf(afterLines("add_stem 4 8\njoin_stems 1 4\n"), 1), (Ids{1, 2, 3, 4, 8}));
  EXPECT_EQ(nodesOf(afterLines("attach_stem 3 6\njoin_stems 2 3\n"), 2), (Ids{2, 5, 6, 7}));
  EXPECT_EQ(afterLines("attach_stem 3 6\njoin_stems 2 3\n").leaves[2].arrangement.stem, StemId(2));
  EXPECT_EQ(refusalOf("join_stems 1 2"), "stem 2 begins at node 2 of stem 1, not at the tip of stem 1; attach it there first");
  EXPECT_EQ(refusalOf("join_stems 1 1"), "a stem cannot be joined to itself");
  EXPECT_EQ(refusalOf("join_stems 3 1"), "stem 3 would grow out of itself; what begins at its nodes cannot also carry it");
}

TEST(StemCommands, ReverseTurnsAStemThatIsItsOwn) {
  EXPECT_EQ(nodesOf(afterLines("reverse_stem 1"), 1), (Ids{4, 3, 2, 1}));
  EXPECT_EQ(refusalOf("reverse_stem 2"), "stem 2 grows out of stem 1 at node 2 and cannot run towards it; take that node from it first");
  EXPECT_EQ(refusalOf("add_stem 4 8\nreverse_stem 4\n"), "stem 4 has a single node; there is nothing to turn round");
}

TEST(StemCommands, RemoveTakesAllThatHangsOnTheStem) {
  const Project project = afterLines("remove_stem 2");
  EXPECT_EQ(project.stems.size(), 1u);
  EXPECT_EQ(project.leaves.size(), 1u);
  EXPECT_EQ(project.nodes.size(), 5u) << "1 to 4 and 8";
  EXPECT_EQ(afterLines("remove_stem 1").nodes.size(), 1u);
  EXPECT_EQ(refusalOf("remove_stem 7"), "there is no stem 7");
}

// ---- leaves ----------------------------------------------------------------------------------------------------------

TEST(LeavesCommands, AreAddedChangedAndRemovedByTheirPlaceInTheList) {
  EXPECT_EQ(afterLines("change_leaves 2 2 nodes=5").leaves[1].arrangement.nodes, 5);
  EXPECT_EQ(afterLines("remove_leaves 1").leaves[0].arrangement.stem, StemId(2));
  EXPECT_EQ(afterLines("add_leaves 3 nodes=1\nremove_leaves 4\n"), plant());
  EXPECT_EQ(refusalOf("remove_leaves 4"), "there are no leaves number 4; the list has 3");
  EXPECT_EQ(refusalOf("change_leaves 0 2 nodes=5"), "there are no leaves number 0; the list has 3");
}

TEST(LeavesCommands, CopiesStandOnOtherStemsAndNamedNodesBecomeACount) {
  const Project project = afterLines("copy_leaves 2 1 3");
  ASSERT_EQ(project.leaves.size(), 5u);
  EXPECT_EQ(project.leaves[4].arrangement.stem, StemId(3));
  EXPECT_EQ(project.leaves[4].arrangement.nodes, 2);
  EXPECT_TRUE(project.leaves[4].arrangement.at.empty());
  EXPECT_EQ(project.leaves[4].arrangement.length, 0.06);
  EXPECT_EQ(refusalOf("copy_leaves 2 2"), "stem 2 has these leaves already");
  EXPECT_EQ(refusalOf("copy_leaves 2 1\ncopy_leaves 2 1\n"), "stem 1 has these leaves already");
  EXPECT_EQ(refusalOf("copy_leaves 2 9"), "there is no stem 9");
}

TEST(LeavesCommands, RefuseWhatCannotBePlaced) {
  EXPECT_EQ(refusalOf("add_leaves 9 nodes=3"), "there is no stem 9");
  EXPECT_EQ(refusalOf("add_leaves 1"), "say how many leaf nodes there are (nodes=4), or which nodes carry leaves (at=2,3)");
  EXPECT_EQ(refusalOf("add_leaves 1 nodes=0"), "0 leaf nodes are not possible; give 1 to 10000");
  EXPECT_EQ(refusalOf("add_leaves 1 at=7"), "stem 1 has no node 7");
  EXPECT_EQ(refusalOf("add_leaves 1 at=2,3 nodes=3"), "3 leaf nodes are wanted but 2 are listed; give one of the two");
  EXPECT_EQ(refusalOf("add_leaves 1 nodes=3 angle=190"), "the angle between stem and leaf, in degrees, is 190; it must be from 0 to 180");
  EXPECT_EQ(refusalOf("add_leaves 1 nodes=3 length=0"), "the leaf's length must be above zero; leave it out for the description's");
  EXPECT_EQ(refusalOf("add_leaves 1 nodes=3 arrangement=sideways").substr(0, 42), "no leaf arrangement is called 'sideways'; ");
}

TEST(Commands, NeverTouchTheProjectTheyAreGiven) {
  const Project before = plant();
  const std::string text = projectText(before);
  for (const char* line : {"move_click 1 front 5 6", "remove_stem 2", "swap_views front right", "split_stem 1 3 9", "remove_nodes 6", "remove_leaves 1"}) {
    const auto after = replay(before, line);
    ASSERT_TRUE(after) << line;
    EXPECT_NE(projectText(after->project()), text) << line;
    EXPECT_EQ(projectText(before), text) << line;
  }
}

TEST(Commands, ADamagedProjectIsRefusedOrEditedButNeverACrash) {
  Project damaged = plant();
  ProjectStem stem;
  stem.stem.id = StemId(2);
  stem.stem.nodes = {NodeId(77), NodeId(77), NodeId(3), NodeId(5)};
  damaged.stems.push_back(stem);
  stem.stem.id = StemId(5);
  stem.stem.nodes.clear();
  damaged.stems.push_back(stem);
  for (const char* line : {"remove_stem 2", "remove_stem 5", "remove_nodes 3", "append_node 5 8", "attach_stem 5 8", "join_stems 1 5", "join_stems 5 1",
                           "reverse_stem 5", "remove_from_stem 5 1", "split_stem 2 5 9", "insert_node 2 8 77"}) {
    const Replayed replayed = replayWhatApplies(damaged, line);
    EXPECT_LE(replayed.faults.size(), 1u);
  }
}

}  // namespace
}  // namespace axil::document
