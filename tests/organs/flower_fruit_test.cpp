#include "organs/flower.hpp"
#include "organs/fruit.hpp"
#include "organs/leaf.hpp"

#include "mesh_checks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace axil::organs {
namespace {

using test::expectSound;
using test::trianglesOf;

constexpr std::array allDetails{Detail::Close, Detail::Medium, Detail::Far};

TEST(FlowerParts, AreSoundMeshesAtEveryDetail) {
  ASSERT_GE(flowerShapes().size(), 10u);
  for (const FlowerShape& shape : flowerShapes())
    for (const Detail detail : allDetails)
      for (const Part& part : flowerParts(shape, detail)) expectSound(part, shape.name);
}

TEST(FlowerParts, HaveAsManyPetalsAsTheShapeSays) {
  for (const FlowerShape& shape : flowerShapes()) {
    const std::vector<Part> parts = flowerParts(shape, Detail::Close);
    const auto petals = std::find_if(parts.begin(), parts.end(), [](const Part& p) { return p.name == "petal"; });
    ASSERT_NE(petals, parts.end()) << shape.name;
    if (shape.fused > 0) {  // one piece with a lobe a petal
      FlowerShape more = shape;
      more.petals += 1;
      const std::size_t whole = petals->mesh.triangles.size();
      EXPECT_EQ(trianglesOf({*petals}) % static_cast<std::size_t>(shape.petals), 0u) << shape.name;
      EXPECT_GT(trianglesOf(flowerParts(more, Detail::Close)), whole / 3) << shape.name;
      continue;
    }
    const std::size_t one = leafParts(*leafShapeNamed(shape.petalShape), shape.petalWidthToLength, Detail::Medium).front().mesh.triangles.size();
    EXPECT_EQ(petals->mesh.triangles.size(), one * static_cast<std::size_t>(shape.petals * shape.whorls)) << shape.name;
  }
}

TEST(FlowerParts, StayWithinTheirLength) {
  for (const FlowerShape& shape : flowerShapes())
    for (const Part& part : flowerParts(shape, Detail::Close))
      for (const glm::vec3& p : part.mesh.positions) EXPECT_LE(glm::length(p), 1.35f) << shape.name << " " << part.name;
}

TEST(FlowerParts, GetLighterWithDistance) {
  for (const FlowerShape& shape : flowerShapes()) {
    const std::size_t close = trianglesOf(flowerParts(shape, Detail::Close));
    const std::size_t medium = trianglesOf(flowerParts(shape, Detail::Medium));
    const std::size_t far = trianglesOf(flowerParts(shape, Detail::Far));
    EXPECT_GT(close, medium) << shape.name;
    EXPECT_GT(medium, far) << shape.name;
    EXPECT_LE(close, 1500u) << shape.name;
  }
}

TEST(FruitParts, AreSoundMeshesAtEveryDetail) {
  ASSERT_GE(fruitShapes().size(), 10u);
  for (const FruitShape& shape : fruitShapes())
    for (const Detail detail : allDetails)
      for (const Part& part : fruitParts(shape, detail)) expectSound(part, shape.name);
}

TEST(FruitParts, FillTheirUnitLength) {
  for (const FruitShape& shape : fruitShapes()) {
    float top = 0;
    float bottom = 1;
    for (const Part& part : fruitParts(shape, Detail::Close))
      for (const glm::vec3& p : part.mesh.positions) {
        top = std::max(top, p.y);
        bottom = std::min(bottom, p.y);
      }
    EXPECT_NEAR(top, 1, 0.2) << shape.name;
    EXPECT_NEAR(bottom, 0, 0.12) << shape.name;
  }
}

TEST(FruitParts, ClosedBodiesAreWatertight) {
  const std::optional<FruitShape> shape = fruitShapeNamed("drupe");
  ASSERT_TRUE(shape);
  const Mesh body = fruitParts(*shape, Detail::Close).front().mesh;
  // The seam has two vertices at each place, so edges are compared by place.
  std::vector<std::array<float, 6>> edges;
  const auto edge = [&](std::uint32_t a, std::uint32_t b) {
    const glm::vec3 p = body.positions[a];
    const glm::vec3 q = body.positions[b];
    edges.push_back({p.x, p.y, p.z, q.x, q.y, q.z});
  };
  for (std::size_t t = 0; t < body.triangles.size(); t += 3)
    for (std::size_t k = 0; k < 3; ++k) edge(body.triangles[t + k], body.triangles[t + (k + 1) % 3]);
  for (const auto& e : edges) {
    const std::array<float, 6> back{e[3], e[4], e[5], e[0], e[1], e[2]};
    EXPECT_EQ(std::count(edges.begin(), edges.end(), back), 1);
  }
}

}  // namespace
}  // namespace axil::organs
