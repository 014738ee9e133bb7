#include "render/mesh_files.hpp"

#include "base/files.hpp"
#include "render/known_plants.hpp"
#include "render/plant_mesh.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>

namespace axil::render {
namespace {

PlantMesh meshOfShrub() { return meshOf(test::shrub(1)).value(); }

/// Files worth a look, or another program's check, are kept where AXIL_PICTURES says.
void keep(const std::string& name, const std::string& bytes) {
  const char* folder = std::getenv("AXIL_PICTURES");
  if (folder == nullptr) return;
  ASSERT_TRUE(writeFile(std::filesystem::path(folder) / name, bytes));
}

std::uint32_t wordAt(const std::string& bytes, std::size_t at) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, 4);
  return word;
}

std::string jsonOf(const std::string& glb) { return glb.substr(20, wordAt(glb, 12)); }

std::size_t countOf(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + what.size())) ++count;
  return count;
}

TEST(Glb, IsAWellFormedContainer) {
  const auto glb = glbBytes(meshOfShrub());
  ASSERT_TRUE(glb) << glb.error().message;
  keep("shrub.glb", *glb);
  EXPECT_EQ(glb->substr(0, 4), "glTF");
  EXPECT_EQ(wordAt(*glb, 4), 2u);
  EXPECT_EQ(wordAt(*glb, 8), glb->size());
  const std::size_t binary = 20 + wordAt(*glb, 12);
  EXPECT_EQ(glb->substr(binary + 4, 4), std::string("BIN\0", 4));
  EXPECT_EQ(binary + 8 + wordAt(*glb, binary), glb->size());
}

TEST(Glb, HasANodeForEveryLeafAndOneMeshAModel) {
  const PlantMesh mesh = meshOfShrub();
  std::size_t copies = 0;
  for (const OrganModel& model : mesh.models) copies += model.placements.size();
  const std::string json = jsonOf(*glbBytes(mesh, {.storage = ModelStorage::Shared}));
  EXPECT_EQ(countOf(json, "\"rotation\""), copies);
  EXPECT_EQ(countOf(json, "\"primitives\""), mesh.models.size() + 1);
  EXPECT_GE(countOf(json, "\"doubleSided\":true"), 1u);
}

TEST(Glb, MergedLeavesNeedNoNodes) {
  const auto glb = glbBytes(meshOfShrub(), {.storage = ModelStorage::Merged});
  ASSERT_TRUE(glb);
  keep("shrub_merged.glb", *glb);
  EXPECT_EQ(countOf(jsonOf(*glb), "\"rotation\""), 0u);
}

TEST(Glb, AnEmptyPlantIsAFileToo) {
  const auto glb = glbBytes(PlantMesh{});
  ASSERT_TRUE(glb) << glb.error().message;
  keep("empty.glb", *glb);
  EXPECT_EQ(wordAt(*glb, 8), glb->size());
}

TEST(Glb, AUnitThatIsNoLengthIsRefused) {
  EXPECT_FALSE(glbBytes(meshOfShrub(), {.metresPerUnit = 0}));
  EXPECT_EQ(countOf(jsonOf(*glbBytes(meshOfShrub(), {.storage = ModelStorage::Merged, .metresPerUnit = 0.01})), "\"scale\":[0.01,0.01,0.01]"), 1u);
}

TEST(Obj, CountsAgreeAndIndicesExist) {
  const PlantMesh mesh = meshOfShrub();
  const auto files = objAndMtl(mesh, "shrub.mtl");
  ASSERT_TRUE(files);
  keep("shrub.obj", files->obj);
  keep("shrub.mtl", files->mtl);
  EXPECT_EQ(countOf(files->obj, "\nf "), mesh.triangleCount());
  EXPECT_EQ(countOf(files->obj, "\nv "), countOf(files->obj, "\nvn "));
  EXPECT_EQ(countOf(files->mtl, "newmtl "), mesh.materials.size());
  EXPECT_EQ(countOf(files->obj, ","), 1u);  // the comment's: numbers have points
  EXPECT_NE(files->obj.find("mtllib shrub.mtl"), std::string::npos);
  const std::size_t vertices = countOf(files->obj, "\nv ");
  std::size_t largest = 0;
  for (std::size_t at = files->obj.find("\nf "); at != std::string::npos; at = files->obj.find("\nf ", at + 1))
    largest = std::max<std::size_t>(largest, std::strtoul(files->obj.c_str() + at + 3, nullptr, 10));
  EXPECT_LE(largest, vertices);
  EXPECT_FALSE(objAndMtl(mesh, "two words.mtl"));
}

TEST(Ply, IsAsLongAsItsHeaderSays) {
  const std::string ply = plyBytes(meshOfShrub());
  keep("shrub.ply", ply);
  const auto numberAfter = [&](const std::string& word) { return std::strtoul(ply.c_str() + ply.find(word) + word.size(), nullptr, 10); };
  const std::size_t body = ply.find("end_header\n") + 11;
  EXPECT_EQ(ply.size(), body + 27 * numberAfter("element vertex ") + 17 * numberAfter("element face "));
  EXPECT_EQ(numberAfter("element face "), meshOfShrub().triangleCount());
}

TEST(MeshFiles, AreTheSameBytesTwice) {
  EXPECT_EQ(*glbBytes(meshOfShrub()), *glbBytes(meshOfShrub()));
  EXPECT_EQ(objAndMtl(meshOfShrub(), "a.mtl")->obj, objAndMtl(meshOfShrub(), "a.mtl")->obj);
  EXPECT_EQ(plyBytes(meshOfShrub()), plyBytes(meshOfShrub()));
}

TEST(MeshFiles, WrittenStraightIntoFilesTheyAreTheSameBytes) {
  const std::filesystem::path folder = std::filesystem::path(::testing::TempDir()) / "axil_mesh_files";
  std::filesystem::remove_all(folder);
  const PlantMesh mesh = meshOfShrub();
  for (const ModelStorage storage : {ModelStorage::Shared, ModelStorage::Merged}) {
    ASSERT_TRUE(writeGlb(mesh, folder / "a.glb", {.storage = storage}));
    EXPECT_EQ(*readFile(folder / "a.glb"), *glbBytes(mesh, {.storage = storage}));
  }
  ASSERT_TRUE(writeObj(mesh, folder / "my plant.obj"));
  const auto files = objAndMtl(mesh, "my_plant.mtl");
  EXPECT_EQ(*readFile(folder / "my plant.obj"), files->obj);
  EXPECT_EQ(*readFile(folder / "my_plant.mtl"), files->mtl);
  EXPECT_FALSE(writeGlb(mesh, folder / "a.glb" / "b.glb"));
  EXPECT_FALSE(writeGlb(mesh, folder / "c.glb", {.metresPerUnit = -1}));
  EXPECT_FALSE(std::filesystem::exists(folder / "c.glb"));
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace axil::render
