// What spares a ray work, and must never cost it a hit: boxes in entries, empty cubes of bricks.
#include <span>

#include <halfsilver/renderer.h>
#include "gpu/tracing_scenes.h"
#include "tracing/identity/entry_layout.h"

namespace halfsilver::testing {
namespace {

class Entries : public TracingTest {
 protected:
  void expectExact(const Scene& scene, const Frame& frame) {
    const Frame exact = draw(scene, kAbove, settingsWith({{"trace.method", "exact"}}), 80, 60);
    const HitErrors errors = compareHits(frame, exact, scene.bounds().diagonal());
    expectNontrivial(errors, exact);
    EXPECT_EQ(errors.hitError, 0);
    EXPECT_EQ(errors.wrongId, 0);
    EXPECT_EQ(frame.report.overflow, 0u);
  }
};

TEST_F(Entries, LeaveTheBoxTheBitsThatTrianglesDoNotNeed) {
  EXPECT_EQ(EntryLayout::of(1).slices, 4);
  EXPECT_EQ(EntryLayout::of(1U << 20).slices, 4);
  EXPECT_EQ(EntryLayout::of((1U << 20) + 1).slices, 3);
  EXPECT_EQ(EntryLayout::of(1U << 23).slices, 3);
  EXPECT_EQ(EntryLayout::of((1U << 23) + 1).slices, 2);
  EXPECT_EQ(EntryLayout::of((1U << 26) + 1).slices, 0);
}

// The triangles that no ray comes near leave fewer bits to the boxes of the others.
TEST_F(Entries, AreExactWithCoarserBoxes) {
  Scene scene = soup(1500);
  const std::uint32_t first = static_cast<std::uint32_t>(scene.vertices.size());
  addTriangle(scene, {-0.5f, -3, 0}, {-0.5f, -3.01f, 0}, {-0.51f, -3, 0}, 1);
  scene.triangles.resize((1U << 20) + 100, scene.triangles.back());
  ASSERT_EQ(scene.triangles.back().vertices[0], first);
  const Settings settings = settingsWith({{"voxels.resolution", "40"}, {"voxels.per_triangle", "0"}});
  const Frame frame = draw(scene, kAbove, settings, 80, 60);
  expectExact(scene, frame);
  EXPECT_LT(frame.report.memory.fragmentsStored, 1U << 18) << "no ray asked for those";
}

// Rays that leap over the middle of the scene, until something comes there.
TEST_F(Entries, AreFoundInBricksThatWereEmpty) {
  Scene scene = soup(400);
  for (Vertex& vertex : scene.vertices) vertex.position.y *= 4;  // room between the triangles
  const Settings settings = settingsWith({{"voxels.resolution", "256"}, {"voxels.per_triangle", "0"}});
  const std::uint32_t first = static_cast<std::uint32_t>(scene.vertices.size());
  addTriangle(scene, {3, 9, 0}, {3, 8, 0}, {2, 9, 0}, 1);
  Renderer renderer = makeRenderer(scene);
  const Frame before = drawWith(renderer, kAbove, settings, 80, 60);
  scene.vertices[first].position = {-0.8f, 1.5f, -0.8f};
  scene.vertices[first + 1].position = {0.8f, 1.6f, -0.8f};
  scene.vertices[first + 2].position = {0, 1.7f, 0.8f};
  const VertexRange moved{first, 3};
  renderer.updateVertices(scene, std::span(&moved, 1));
  const Frame after = drawWith(renderer, kAbove, settings, 80, 60);
  EXPECT_NE(after.layers.data, before.layers.data);
  EXPECT_EQ(after.layers.data, draw(scene, kAbove, settings, 80, 60).layers.data);
  expectExact(scene, after);
}

}  // namespace
}  // namespace halfsilver::testing
