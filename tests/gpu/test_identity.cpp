// Exactness and lists on demand of the identity method.
#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include <halfsilver/error.h>
#include "gpu/shader_function.h"
#include "gpu/tracing_scenes.h"

namespace halfsilver::testing {
namespace {

struct IdentityCase {
  const char* voxels;
  const char* axis;
};

class ExactTest : public TracingTest {
 protected:
  // The default preset's picture, which must be that of exact rays.
  Frame expectExactFromAbove(const Scene& scene) {
    const Frame exact = draw(scene, kAbove, settingsWith({{"trace.method", "exact"}}), 80, 60);
    const Frame frame = draw(scene, kAbove, settingsWith({}), 80, 60);
    const HitErrors errors = compareHits(frame, exact, scene.bounds().diagonal());
    expectNontrivial(errors, exact);
    EXPECT_EQ(errors.hitError, 0);
    EXPECT_EQ(errors.wrongId, 0);
    EXPECT_EQ(frame.report.overflow, 0u);
    return frame;
  }
};

class IdentityTest : public TracingTest, public ::testing::WithParamInterface<IdentityCase> {};

// DDA against brute force: whatever the resolutions and the rule for axes, nothing is missed.
TEST_P(IdentityTest, EqualsExactRays) {
  const Scene scene = soup(1500);
  const Frame exact = draw(scene, kAbove, settingsWith({{"trace.method", "exact"}}), 80, 60);
  const Frame frame = draw(
      scene, kAbove,
      settingsWith(
          {{"voxels.resolution", GetParam().voxels}, {"voxels.per_triangle", "0"}, {"voxels.axis", GetParam().axis}}),
      80, 60);
  const HitErrors errors = compareHits(frame, exact, scene.bounds().diagonal());
  expectNontrivial(errors, exact);
  EXPECT_EQ(errors.hitError, 0);
  EXPECT_EQ(errors.wrongId, 0);
  EXPECT_EQ(frame.report.overflow, 0u);
  EXPECT_EQ(frame.report.lostFragments, 0u);
}

INSTANTIATE_TEST_SUITE_P(Resolutions, IdentityTest,
                         ::testing::Values(IdentityCase{"1", "own"}, IdentityCase{"7", "own"},
                                           IdentityCase{"32", "own"}, IdentityCase{"130", "own"},
                                           IdentityCase{"400", "own"}, IdentityCase{"32", "area"},
                                           IdentityCase{"20", "normal"}));

// A scene of a few millimetres and one of ten million units give the same answers as one of meters.
TEST_F(TracingTest, EveryScaleIsExact) {
  for (const float scale : {1e-3f, 1.0f, 5e6f}) {
    Scene scene = soup(1500);
    for (Vertex& vertex : scene.vertices) vertex.position *= scale;
    Camera camera = kAbove;
    camera.eye *= scale;
    camera.target *= scale;
    const Frame exact = draw(scene, camera, settingsWith({{"trace.method", "exact"}}), 80, 60);
    const Frame frame = draw(scene, camera, settingsWith({}), 80, 60);
    const HitErrors errors = compareHits(frame, exact, scene.bounds().diagonal());
    expectNontrivial(errors, exact);
    EXPECT_EQ(errors.hitError, 0) << scale;
    EXPECT_EQ(errors.wrongId, 0) << scale;
    EXPECT_EQ(frame.report.overflow, 0u) << scale;
  }
}

// Thousands of thin rods that cross the whole scene: each touches many voxels, and voxels hold many of them.
TEST_F(ExactTest, LatticesOfThinRods) {
  Scene scene;
  scene.materials = {mirrorMaterial(), plain({0.8f, 0.3f, 0.2f})};
  scene.materials[1].doubleSided = true;
  addQuad(scene, {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}, 0);
  const int side = 40;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      const float a = -1.9f + 3.8f * static_cast<float>(i) / side, b = 0.1f + 1.5f * static_cast<float>(j) / side;
      const float w = 0.0015f;
      addQuad(scene, {-2, b, a}, {2, b, a}, {2, b + w, a + w}, {-2, b + w, a + w}, 1);
      addQuad(scene, {a, b, -2}, {a, b, 2}, {a + w, b + w, 2}, {a + w, b + w, -2}, 1);
    }
  expectExactFromAbove(scene);
}

// A ground to the horizon is tested by every ray; the grid is that of what stands on it, and the picture the same.
TEST_F(ExactTest, TrianglesBeyondTheGrid) {
  Scene scene = soup(1500);
  addQuad(scene, {-900, 0.001f, 900}, {900, 0.001f, 900}, {900, 0.001f, 2.5f}, {-900, 0.001f, 2.5f}, 1);
  addQuad(scene, {-900, 500, -600}, {900, 500, -600}, {900, -1, -500}, {-900, -1, -500}, 1);
  const auto wall = static_cast<float>(scene.triangles.size() - 1);
  ASSERT_EQ(scene.triangles[static_cast<std::size_t>(wall)].material, 1u);
  // The tolerance follows the diagonal, but the triangles are compared, too.
  const Frame frame = expectExactFromAbove(scene);
  const std::vector<float> ids = frame.plane("hit.id");
  EXPECT_GT(std::count_if(ids.begin(), ids.end(), [&](float id) { return id >= wall - 1 && id <= wall; }), 100);
}

// Conservative rasterization against a CPU count of the texels that a triangle touches (separating axes in double).
TEST_F(TracingTest, ConservativeFragmentsCoverWhatTheTriangleTouches) {
  Scene scene;
  scene.materials = {mirrorMaterial(), plain({1, 1, 1})};
  addTriangle(scene, {0, 0, 4}, {4, 0, 4}, {0, 0, 0}, 0);
  addTriangle(scene, {0, 4, 0}, {0.001f, 4, 0}, {0, 4, 0.001f}, 1);  // gives the bounds their height
  const double pad = 4e-3, extent = 4 + 2 * pad;
  const int n = 52;
  std::uint64_t least = 0, most = 0;
  for (int z = 0; z < n; ++z)
    for (int x = 0; x < n; ++x) {
      // The triangle covers x from 0 to z, z from 0 to 4: a texel touches it when its nearest corner does.
      const double cell = extent / n, x0 = x * cell - pad, z1 = (z + 1) * cell - pad;
      const double z0 = z * cell - pad, x1 = x0 + cell;
      const double slack = 0.03 * cell;
      const auto touches = [&](double grow) {
        return x0 - grow <= z1 + grow && x0 - grow <= 4 && x1 + grow >= 0 && z0 - grow <= 4 && z1 + grow >= 0;
      };
      least += touches(0) ? 1u : 0u;
      most += touches(slack) ? 1u : 0u;
    }
  Frame frame;
  withShaders({kNoPairs}, [&] {
    frame = draw(scene, lookAt({1, 3, 6}, {1, 0, 3}),
                 settingsWith({{"voxels.resolution", "52"}, {"voxels.per_triangle", "0"}}), 16, 12);
  });
  // All of a triangle's fragments are made whenever any of them is asked for, and rays ask a few times.
  const std::uint64_t made = frame.report.memory.fragments, times = (made + least / 2) / least;
  EXPECT_GT(least, 1000u);
  EXPECT_GE(times, 1u);
  EXPECT_LE(times, 3u);
  // The small triangle adds its own texels, at most four.
  EXPECT_GE(made, times * least);
  EXPECT_LE(made, times * (most + 4));
  // Only bricks that rays come by are stored.
  EXPECT_GT(frame.report.memory.fragmentsStored, 10u);
  EXPECT_LT(frame.report.memory.fragmentsStored, made * 9 / 10);
}

class LongListTest : public TracingTest {
 protected:
  // Draws with a grid of `voxels` along the longest side; what every such frame owes is that its rays are exact.
  Frame drawExactly(const Scene& scene, const Camera& camera, const char* voxels, int width, int height) {
    const Frame exact = draw(scene, camera, settingsWith({{"trace.method", "exact"}}), width, height);
    const Frame frame =
        draw(scene, camera, settingsWith({{"voxels.resolution", voxels}, {"voxels.per_triangle", "0"}}), width, height);
    const HitErrors errors = compareHits(frame, exact, scene.bounds().diagonal());
    EXPECT_GT(errors.rays, 200u);
    EXPECT_EQ(errors.hitError, 0);
    EXPECT_EQ(errors.wrongId, 0);
    EXPECT_EQ(frame.report.overflow, 0u);
    return frame;
  }
};

// The nearest of many sheets is found wherever it is in its list.
TEST_F(LongListTest, ThousandsOfEntriesAreComplete) {
  const Frame frame = drawExactly(manySheets(1500), kBelowSheets, "2", 40, 30);
  EXPECT_GT(frame.report.selected, 500u);
  EXPECT_GT(frame.report.memory.fragmentsStored, 3000u);
}

// Nearly everything in one voxel: rays leave a list half done where the driver's loops end, and go on in the next
// dispatch.
TEST_F(LongListTest, BeyondTheLoopLimitIsComplete) {
  Scene scene = soup(30000);
  addTriangle(scene, {40, 40, 40}, {40, 39.99f, 40}, {39.99f, 40, 40}, 1);  // stretches the grid
  const Frame frame = drawExactly(scene, kAbove, "4", 120, 90);
  EXPECT_EQ(frame.report.memory.fragmentsStored, 30003u);
}

// Rays in the plane of voxel edges, beside long lists: their stretches in the voxels beyond the edge are shorter than
// rounding, and leaving those to the next dispatch must not send them back for ever.
TEST_F(LongListTest, RaysAlongVoxelEdgesComeThrough) {
  Scene scene;
  scene.materials = {mirrorMaterial(), plain({0.8f, 0.3f, 0.2f})};
  addQuad(scene, {-1, -1, 1}, {1, -1, 1}, {1, -1, -1}, {-1, -1, -1}, 0);
  addTriangle(scene, {1, 1, 1}, {1, 0.999f, 1}, {0.999f, 1, 1}, 1);
  addTriangle(scene, {-1, 1, -1}, {-1, 0.999f, -1}, {-0.999f, 1, -1}, 1);
  const int count = 24000;
  for (int i = 0; i < count; ++i) {
    const float c = -0.99f + 1.98f * static_cast<float>(i) / count, h = 1 - std::abs(c);
    addTriangle(scene, {c - h, -0.99f, c + h}, {c, 0.99f, c}, {c + h, -0.99f, c - h}, 1);
  }
  drawExactly(scene, lookAt({0.95f, -0.3f, 0.95f}, {-0.2f, -1, -0.2f}), "4", 41, 31);
}

// What is built is what rays need, in memory of that size; it stays, and grows by what other rays need.
TEST_F(TracingTest, ListsAreBuiltOnDemandAndStay) {
  const Scene scene = soup(3000);
  const Settings kept = settingsWith({}), rebuilt = settingsWith({{"abuffer.keep", "false"}});
  Renderer renderer = makeRenderer(scene);
  const Camera other = lookAt({1.5f, 1.2f, 2.0f}, {0, 0.1f, 0});
  const Frame few = drawWith(renderer, kAbove, settingsWith({{"select.fraction", "0.02"}}), 80, 60);
  const Frame all = drawWith(renderer, kAbove, kept, 80, 60);
  const Frame again = drawWith(renderer, kAbove, kept, 80, 60);
  const Frame moved = drawWith(renderer, other, kept, 80, 60);
  EXPECT_GT(few.report.memory.fragmentsStored, 20u);
  EXPECT_LT(few.report.memory.fragmentsStored, all.report.memory.fragmentsStored / 2);
  EXPECT_EQ(again.report.memory.fragmentsStored, all.report.memory.fragmentsStored);
  EXPECT_GT(moved.report.memory.fragmentsStored, all.report.memory.fragmentsStored);
  for (const Frame* frame : {&few, &all, &moved}) {
    const MemoryReport& memory = frame->report.memory;
    EXPECT_EQ(memory.poolUsed, memory.fragmentsStored * 4);
    EXPECT_LE(static_cast<double>(memory.poolReserved), 1.10 * static_cast<double>(memory.poolUsed) + 16);
    EXPECT_EQ(frame->report.overflow, 0u);
  }
  // Pictures are those of a full rebuild, to the bit.
  EXPECT_EQ(all.layers.data, again.layers.data);
  EXPECT_EQ(all.layers.data, drawOnce(scene, kAbove, rebuilt, 80, 60).layers.data);
  EXPECT_EQ(moved.layers.data, drawOnce(scene, other, rebuilt, 80, 60).layers.data);
}

// What other views and places needed is gone, and what is built then is what a first frame builds.
TEST_F(TracingTest, ForgottenStructuresAreBuiltAnew) {
  Scene scene = soup(3000);
  const Settings kept = settingsWith({});
  Renderer renderer = makeRenderer(scene);
  drawWith(renderer, lookAt({1.5f, 1.2f, 2.0f}, {0, 0.1f, 0}), kept, 80, 60);
  const Frame both = drawWith(renderer, kAbove, kept, 80, 60);
  renderer.forgetStructures();
  const VertexRange range{0, 300};
  for (std::uint32_t v = 0; v < range.count; ++v) scene.vertices[v].position.y += 0.05f;
  renderer.updateVertices(scene, std::span(&range, 1));
  const Frame forgotten = drawWith(renderer, kAbove, kept, 80, 60);
  const Frame first = drawOnce(scene, kAbove, kept, 80, 60);
  EXPECT_EQ(forgotten.layers.data, first.layers.data);
  EXPECT_EQ(forgotten.report.memory.fragmentsStored, first.report.memory.fragmentsStored);
  EXPECT_LT(forgotten.report.memory.fragmentsStored, both.report.memory.fragmentsStored);
  EXPECT_GT(first.report.memory.fragmentsStored, 100u);
}

// A frame in which an object moves rebuilds what that object touches; pictures are those of a full rebuild.
TEST_F(TracingTest, MovingTrianglesAreFollowed) {
  Scene scene = soup(2000);
  // Corners that keep the bounds as they are.
  addTriangle(scene, {-2.2f, -0.2f, -2.2f}, {-2.2f, -0.19f, -2.2f}, {-2.19f, -0.2f, -2.2f}, 1);
  addTriangle(scene, {2.2f, 2.0f, 2.2f}, {2.2f, 1.99f, 2.2f}, {2.19f, 2.0f, 2.2f}, 1);
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  for (int i = 0; i < 20; ++i) {
    const float x = 0.02f * static_cast<float>(i);
    addTriangle(scene, {x, 0.3f, 0}, {x + 0.3f, 0.3f, 0.1f}, {x, 0.7f, 0.2f}, 1);
  }
  const VertexRange moving{first, static_cast<std::uint32_t>(scene.vertices.size()) - first};
  Renderer renderer = makeRenderer(scene);
  const Settings kept = settingsWith({});
  Frame frame = drawWith(renderer, kAbove, kept, 80, 60);
  for (int step = 0; step < 8; ++step) {
    for (std::uint32_t v = moving.first; v < moving.first + moving.count; ++v)
      scene.vertices[v].position += glm::vec3(-0.11f, 0.08f, 0.09f);
    renderer.updateVertices(scene, std::span(&moving, 1));
    const std::uint64_t madeBefore = frame.report.memory.fragments;
    frame = drawWith(renderer, kAbove, kept, 80, 60);
    const Frame rebuilt = drawOnce(scene, kAbove, kept, 80, 60);
    EXPECT_EQ(frame.layers.data, rebuilt.layers.data) << step;
    EXPECT_EQ(frame.report.overflow, 0u);
    // Less is made than by building everything, and the pool stays close to what it holds.
    const MemoryReport& memory = frame.report.memory;
    EXPECT_LT(memory.fragments - madeBefore, rebuilt.report.memory.fragments / 2) << step;
    EXPECT_LE(static_cast<double>(memory.poolReserved), 1.12 * static_cast<double>(memory.poolUsed)) << step;
    const HitErrors errors = compareHits(frame, draw(scene, kAbove, settingsWith({{"trace.method", "exact"}}), 80, 60),
                                         scene.bounds().diagonal());
    EXPECT_EQ(errors.hitError, 0) << step;
    std::set<float> ids;
    for (const float id : frame.plane("hit.id")) ids.insert(id);
    EXPECT_GT(std::count_if(ids.begin(), ids.end(), [](float id) { return id >= 2004; }), 0) << step;
  }
}

// What moves out of the scene's bounds makes a new grid now and then, not in every frame; so does what comes back.
TEST_F(TracingTest, MovesBeyondTheBoundsBuildEverythingOnlyNowAndThen) {
  Scene scene = soup(2000);
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  for (int i = 0; i < 20; ++i) {
    const float x = 0.02f * static_cast<float>(i);
    addTriangle(scene, {x, 1.6f, 0}, {x + 0.3f, 1.6f, 0.1f}, {x, 2.3f, 0.2f}, 1);
  }
  const VertexRange moving{first, static_cast<std::uint32_t>(scene.vertices.size()) - first};
  Renderer renderer = makeRenderer(scene);
  const Settings kept = settingsWith({});
  Frame frame = drawWith(renderer, kAbove, kept, 80, 60);
  int whole = 0;
  for (int step = 0; step < 40; ++step) {
    for (std::uint32_t v = moving.first; v < moving.first + moving.count; ++v)
      scene.vertices[v].position.y += step < 25 ? 0.05f : -0.08f;
    renderer.updateVertices(scene, std::span(&moving, 1));
    const std::uint64_t before = frame.report.memory.fragments;
    frame = drawWith(renderer, kAbove, kept, 80, 60);
    const Frame rebuilt = drawOnce(scene, kAbove, kept, 80, 60);
    EXPECT_EQ(frame.layers.data, rebuilt.layers.data) << step;
    // A new grid begins its counts again.
    whole += frame.report.memory.fragments < before ? 1 : 0;
    EXPECT_LT(frame.report.memory.structureTotal, rebuilt.report.memory.structureTotal * 3 / 2) << step;
  }
  EXPECT_GE(whole, 1);
  EXPECT_LE(whole, 6);
}

// Lists do not grow along the way of what moves, and several changes between two frames are followed like one.
TEST_F(TracingTest, MovingTrianglesLeaveNothingBehind) {
  Scene scene = soup(2000);
  addTriangle(scene, {-2.2f, -0.2f, -2.2f}, {-2.2f, -0.19f, -2.2f}, {-2.19f, -0.2f, -2.2f}, 1);
  addTriangle(scene, {2.2f, 2.0f, 2.2f}, {2.2f, 1.99f, 2.2f}, {2.19f, 2.0f, 2.2f}, 1);
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  for (int i = 0; i < 600; ++i) {
    const float x = -1.5f + 0.001f * static_cast<float>(i % 25), z = -1 + 0.004f * static_cast<float>(i / 25);
    addTriangle(scene, {x, 0.2f, z}, {x + 0.02f, 0.2f, z}, {x, 0.22f, z}, 1);
  }
  const std::uint32_t half = 900;
  const VertexRange parts[] = {{first, half}, {first + half, half}};
  ASSERT_EQ(scene.vertices.size(), first + 2 * half);
  Renderer renderer = makeRenderer(scene);
  const Settings kept = settingsWith({});
  Frame frame = drawWith(renderer, kAbove, kept, 80, 60);
  for (int step = 0; step < 25; ++step) {
    for (std::uint32_t v = first; v < first + 2 * half; ++v) scene.vertices[v].position.x += 0.1f;
    for (const VertexRange& part : parts) renderer.updateVertices(scene, std::span(&part, 1));
    frame = drawWith(renderer, kAbove, kept, 80, 60);
  }
  const Frame rebuilt = drawOnce(scene, kAbove, kept, 80, 60);
  EXPECT_EQ(frame.layers.data, rebuilt.layers.data);
  // Besides what other views would need, only the place where they stood first holds them still: 600 in a list or two.
  EXPECT_LT(frame.report.memory.fragmentsStored, rebuilt.report.memory.fragmentsStored + 2 * 600);
  EXPECT_GT(frame.report.memory.fragments, rebuilt.report.memory.fragments) << "everything was rebuilt";
}

// A bad range is refused before anything has moved.
TEST_F(TracingTest, BadRangesChangeNothing) {
  Scene scene = soup(500);
  Renderer renderer = makeRenderer(scene);
  const Settings settings = settingsWith({});
  const Frame before = drawWith(renderer, kAbove, settings, 80, 60);
  const auto count = static_cast<std::uint32_t>(scene.vertices.size());
  for (std::uint32_t v = 6; v < count; ++v) scene.vertices[v].position += glm::vec3(0.2f, 0.1f, -0.2f);
  const VertexRange ranges[] = {{6, count - 6}, {count, 5}};
  EXPECT_THROW(renderer.updateVertices(scene, ranges), Error);
  EXPECT_EQ(drawWith(renderer, kAbove, settings, 80, 60).layers.data, before.layers.data);
}

}  // namespace
}  // namespace halfsilver::testing
