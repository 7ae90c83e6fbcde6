// The bvh method beyond the contract of all methods.
#include <string>

#include "gpu/shader_function.h"
#include "gpu/tracing_scenes.h"

namespace halfsilver::testing {
namespace {

const Settings kBvh = settingsWith({{"trace.method", "bvh"}}), kExact = settingsWith({{"trace.method", "exact"}});

// Sheets over a mirror that face away from it, below one that faces it.
Scene invisibleSheets(int sheets) {
  Scene scene;
  scene.materials = {mirrorMaterial(), plain({1, 1, 1})};
  addQuad(scene, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, 0);
  for (int i = 0; i < sheets; ++i) {
    const float y = 0.5f + 1e-4f * static_cast<float>(i);
    addQuad(scene, {-1, y, 1}, {1, y, 1}, {1, y, -1}, {-1, y, -1}, 1);
  }
  addQuad(scene, {-9, 2, -9}, {9, 2, -9}, {9, 2, 9}, {-9, 2, 9}, 1);
  return scene;
}

// More than a dispatch may do on a software rasterizer: rays pause and find the way back to where they were.
TEST_F(TracingTest, BvhRaysThatPauseGoOn) {
  const Scene scene = invisibleSheets(5000);
  const Frame exact = draw(scene, kBelowSheets, kExact, 40, 30), frame = draw(scene, kBelowSheets, kBvh, 40, 30);
  EXPECT_EQ(frame.report.overflow, 0u);
  EXPECT_GT(frame.report.selected, 300u);
  std::size_t hits = 0;
  const std::vector<float> t = frame.plane("hit.T");
  for (const float each : t) hits += each >= 0 ? 1u : 0u;
  EXPECT_GT(hits, 200u);
  const HitErrors errors = compareHits(frame, exact, scene.bounds().diagonal());
  EXPECT_EQ(errors.hitError, 0);
  EXPECT_EQ(errors.wrongId, 0);
}

// What moves is fitted, then, far from where it was, sorted again; both find what a new tree finds.
TEST_F(TracingTest, BvhFollowsWhatMoves) {
  Scene scene = soup(600);
  Renderer renderer = makeRenderer(scene);
  drawWith(renderer, kAbove, kBvh, 80, 60);
  for (const float by : {0.05f, 1.5f}) {
    SCOPED_TRACE(by);
    // Every other triangle of the soup.
    std::vector<VertexRange> moved;
    for (std::uint32_t vertex = 4; vertex + 3 <= scene.vertices.size(); vertex += 6) {
      for (std::uint32_t i = 0; i < 3; ++i) scene.vertices[vertex + i].position.x += by;
      moved.push_back({vertex, 3});
    }
    renderer.updateVertices(scene, moved);
    const Frame frame = drawWith(renderer, kAbove, kBvh, 80, 60);
    const Frame exact = draw(scene, kAbove, kExact, 80, 60);
    const HitErrors errors = compareHits(frame, exact, scene.bounds().diagonal());
    expectNontrivial(errors, exact);
    EXPECT_EQ(errors.hitError, 0);
    EXPECT_EQ(errors.wrongId, 0);
  }
}

TEST_F(TracingTest, BvhTakesSixtyFourBytesPerNode) {
  const Scene scene = soup(600);
  const Frame frame = draw(scene, kAbove, kBvh, 80, 60);
  const std::uint64_t numbers = 4 * scene.triangles.size(), nodes = frame.report.memory.structureTotal - numbers;
  EXPECT_EQ(nodes % 64, 0u);
  EXPECT_LT(nodes / 64, scene.triangles.size() / 2);
  EXPECT_GT(nodes / 64, scene.triangles.size() / 16);
}

}  // namespace
}  // namespace halfsilver::testing
