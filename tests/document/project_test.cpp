#include "document/project.hpp"

#include "base/files.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace axil::document {
namespace {

const char* const kProject = R"({ "axil": 1, "name": "lantana", "unit": "m", "seed": 7, "mood": {"sunny": true},
  "description": "Shrub; leaves opposite, ovate",
  "views": [ { "name": "front", "photo": "front.jpg", "lens": "50 mm",
      "camera": { "model": "perspective", "focal_px": [2778, 2777], "centre_px": [600, 800], "distortion": [0.1, 0, 0, 0, 0], "maker": "x",
                  "rotation": [[1,0,0],[0,-1,0],[0,0,-1]], "translation": [0, 0.4, 2.0] },
      "origin_px": [602, 1490], "scale": { "from_px": [100, 1500], "to_px": [100, 900], "length": 0.30 } } ],
  "nodes": [ { "id": 1, "clicks": { "front": [602.1, 1490.0], "right": [598.3, 1488.7] }, "placed": { "right": 1.5 }, "radius": 0.004, "colour": "red" } ],
  "stems": [ { "id": 1, "nodes": [1, 2, 3], "note": "main" } ],
  "leaves": [ { "stem": 1, "arrangement": "decussate", "nodes": 4, "angle_deg": 55.1, "roll_deg": 0, "length": 0.06, "shape": "ovate", "colour": 3 } ] })";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// The one detail of a project whose text was changed in one place.
std::string faultAfter(const std::string& from, const std::string& to) {
  const auto project = parseProject(replaced(kProject, from, to));
  if (project) return "no fault";
  return project.error().details.size() == 1 ? project.error().details.front() : project.error().message;
}

TEST(Project, ReadsWhatTheFileSays) {
  const auto project = parseProject(kProject);
  ASSERT_TRUE(project) << project.error().message;
  EXPECT_EQ(project->seed, 7u);
  ASSERT_EQ(project->views.size(), 1u);
  EXPECT_EQ(project->views[0].view.camera.rotation[1][1], -1);
  EXPECT_EQ(project->views[0].view.camera.focal_px->y, 2777);
  EXPECT_EQ(project->nodes[0].node.clicks.at("right").px.x, 598.3);
  EXPECT_EQ(project->nodes[0].node.placed, (std::map<std::string, double>{{"right", 1.5}}));
  EXPECT_NEAR(project->leaves[0].arrangement.angle->degrees(), 55.1, 1e-12);
}

TEST(Project, WhatIsPrintedReadsBackAndPrintsTheSameBytes) {
  const auto project = parseProject(kProject);
  ASSERT_TRUE(project);
  const std::string text = projectText(*project);
  const auto again = parseProject(text);
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(projectText(*again), text);
}

TEST(Project, KeysItDoesNotKnowAreKeptAtEveryPlace) {
  const std::string text = projectText(*parseProject(kProject));
  for (const char* key : {R"("mood": {"sunny":true})", R"("lens":"50 mm")", R"("maker":"x")", R"("colour":"red")", R"("note":"main")", R"("colour":3)"})
    EXPECT_NE(text.find(key), std::string::npos) << key << "\n" << text;
}

TEST(Project, EveryWrongValueIsNamedByItsPath) {
  EXPECT_EQ(faultAfter("[602.1, 1490.0]", "[602.1, \"x\"]"), "nodes[0].clicks.front[1] must be a number, not a text");
  EXPECT_EQ(faultAfter("[602.1, 1490.0]", "[602.1]"), "nodes[0].clicks.front must be a list of 2 numbers");
  EXPECT_EQ(faultAfter("{ \"right\": 1.5 }", "{ \"top\": 1.5 }"), "nodes[0].placed.top names a view that the node has no click in");
  EXPECT_EQ(faultAfter("{ \"right\": 1.5 }", "{ \"right\": -1 }"), "nodes[0].placed.right must not be negative");
  EXPECT_EQ(faultAfter("\"id\": 1, \"clicks\"", "\"clicks\""), "nodes[0].id is missing");
  EXPECT_EQ(faultAfter("\"nodes\": [1, 2, 3]", "\"nodes\": [1, 2.5, 3]"), "stems[0].nodes[1] must be a whole number from 0 to 2147483647");
  EXPECT_EQ(faultAfter("perspective", "fisheye"), "views[0].camera.model is 'fisheye'; it must be orthographic, perspective or unknown");
  EXPECT_EQ(faultAfter("\"length\": 0.30", "\"length\": 0"), "views[0].scale.length must be above zero");
  EXPECT_EQ(faultAfter("[[1,0,0],[0,-1,0],[0,0,-1]]", "[[1,0,0],[0,-1,0]]"), "views[0].camera.rotation must be three rows of three numbers");
  EXPECT_NE(faultAfter("\"axil\": 1", "\"axil\": 2").find("newer version"), std::string::npos);
}

TEST(Project, AllFaultsComeTogether) {
  const auto project = parseProject(replaced(replaced(kProject, "[598.3, 1488.7]", "null"), "\"radius\": 0.004", "\"radius\": -1"));
  ASSERT_FALSE(project);
  EXPECT_EQ(project.error().details.size(), 2u);
}

TEST(Project, BrokenTextSaysWhere) {
  const auto broken = parseProject("{\n \"axil\": 1,\n \"name\": \n}");
  ASSERT_FALSE(broken);
  EXPECT_NE(broken.error().message.find("line 4, column 1"), std::string::npos) << broken.error().message;
  EXPECT_FALSE(parseProject(""));
  EXPECT_FALSE(parseProject("{\"axil\": NaN}"));
  EXPECT_FALSE(parseProject("{\"axil\": 1, \"seed\": 1e999}"));
  EXPECT_FALSE(parseProject("[1, 2]"));
  EXPECT_FALSE(parseProject(std::string("\0\1\2", 3)));
  EXPECT_NE(parseProject(std::string(200000, '[')).error().message.find("100 levels"), std::string::npos);
}

TEST(Project, EveryTruncationIsOneClearError) {
  const std::string text = kProject;
  for (std::size_t length = 0; length + 1 < text.size(); length += 7) {
    const auto project = parseProject(std::string_view(text).substr(0, length));
    ASSERT_FALSE(project) << length;
    EXPECT_FALSE(project.error().message.empty());
  }
}

TEST(Project, Big5IsToldToBecomeUtf8) {
  const auto project = parseProject("{\"axil\": 1, \"name\": \"\xB0\xA8\xC4\xE5\xA4\xA6\"}");
  ASSERT_FALSE(project);
  EXPECT_NE(project.error().message.find("Big5"), std::string::npos);
}

TEST(Project, SavesAndLoads) {
  const std::filesystem::path path = std::filesystem::path(::testing::TempDir()) / "axil_project_test" / "a.axil";
  ASSERT_TRUE(saveProject(*parseProject(kProject), path));
  const auto open = loadProject(path);
  ASSERT_TRUE(open);
  EXPECT_EQ(open->folder, path.parent_path());
  EXPECT_EQ(projectText(open->project), projectText(*parseProject(kProject)));
  std::filesystem::remove_all(path.parent_path());
}

}  // namespace
}  // namespace axil::document
