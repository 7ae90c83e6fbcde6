// Small triangles, which one compute invocation each voxelizes, against the rasterizer; blocks of triangles against
// all.
#include <functional>
#include <vector>

#include "frame/gpu_scene.h"
#include "gpu/tracing_scenes.h"
#include "tracing/voxel_pass.h"

namespace halfsilver::testing {
namespace {

class SmallTriangles : public TracingTest {
 protected:
  // No triangle is small, so the rasterizer voxelizes them all.
  static void withRasterOnly(const std::function<void()>& work) {
    withShaders({{"shared/passes/listed_triangles.h", "#define SMALL_TEXELS 128", "#define SMALL_TEXELS 0"}, kNoPairs},
                work);
  }

  // Triangles of all sizes, slivers along and across the axes among them.
  static Scene manySizes() {
    Scene scene = soup(1200);
    for (int i = 0; i < 60; ++i) {
      const float at = -1.5f + 0.05f * static_cast<float>(i);
      addTriangle(scene, {at, 0, -2}, {at, 1.9f, -2}, {at + 0.001f, 0, 2}, 1);
      addTriangle(scene, {at, 1, at}, {at + 1e-6f, 1, at}, {at, 1 + 1e-6f, at}, 1);
      addTriangle(scene, {at, 0.5f, at}, {at, 0.5f, at}, {at, 0.5f, at}, 1);
    }
    return scene;
  }

  static void expectSameEntries(const Frame& one, const Frame& other) {
    EXPECT_EQ(one.layers.data, other.layers.data);
    const MemoryReport &a = one.report.memory, &b = other.report.memory;
    EXPECT_GT(a.fragmentsStored, 1000u);
    EXPECT_EQ(a.fragmentsStored, b.fragmentsStored);
    EXPECT_EQ(a.heads, b.heads);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(a.fragmentsPerAxis[i], b.fragmentsPerAxis[i]) << i;
  }

  struct Words {
    std::vector<std::uint32_t> marks;
    std::vector<std::int32_t> sums[3];
    bool operator==(const Words&) const = default;
  };

  Words voxelize(const GpuScene& scene, const Grid& grid, AxisRule axis) {
    VoxelPass pass(api, VoxelRaster::conservative, axis);
    gl::Profiler profiler(api);
    Voxels voxels;
    pass.run(scene, profiler, grid, voxels);
    api.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);  // marks and sums (shaders) are read by the host
    Words words{voxels.words.read<std::uint32_t>(voxels.words.bytes() / 4), {}};
    for (int i = 0; i < 3; ++i)
      words.sums[i] = voxels.normalSums[i].read<std::int32_t>(voxels.normalSums[i].bytes() / 4);
    return words;
  }
};

TEST_F(SmallTriangles, MarkTheVoxelsThatTheirFragmentsWouldMark) {
  const GpuScene scene = uploadScene(api, manySizes());
  for (const AxisRule axis : {AxisRule::own, AxisRule::normal, AxisRule::area})
    for (const int voxels : {3, 17, 64, 200}) {
      const Grid grid = makeCubicGrid(scene.extents.bounds(), voxels, 0);
      const Words mixed = voxelize(scene, grid, axis);
      Words raster;
      withRasterOnly([&] { raster = voxelize(scene, grid, axis); });
      EXPECT_TRUE(mixed == raster) << voxels;
      EXPECT_GT(std::count_if(mixed.marks.begin(), mixed.marks.end(), [](std::uint32_t word) { return word != 0; }), 2);
    }
}

TEST_F(SmallTriangles, HaveTheEntriesThatTheirFragmentsWouldHave) {
  const Scene scene = manySizes();
  for (const char* axis : {"own", "area"}) {
    const Settings settings = settingsWith({{"voxels.axis", axis}});
    Frame mixed;
    withShaders({kNoPairs}, [&] { mixed = drawOnce(scene, kAbove, settings, 80, 60); });
    Frame raster;
    withRasterOnly([&] { raster = drawOnce(scene, kAbove, settings, 80, 60); });
    expectSameEntries(mixed, raster);
    const MemoryReport &a = mixed.report.memory, &b = raster.report.memory;
    EXPECT_EQ(a.fragments, b.fragments);
  }
}

// A build of few bricks takes large triangles brick by brick, and makes only the fragments that are stored.
TEST_F(SmallTriangles, AndLargeOnesInFewBricksHaveTheSameEntries) {
  const Scene scene = manySizes();
  for (const char* axis : {"own", "area"}) {
    const Settings settings = settingsWith({{"voxels.axis", axis}});
    const Frame paired = drawOnce(scene, kAbove, settings, 80, 60);
    Frame rasterized;
    withShaders({kNoPairs}, [&] { rasterized = drawOnce(scene, kAbove, settings, 80, 60); });
    expectSameEntries(paired, rasterized);
    EXPECT_LT(paired.report.memory.fragments, rasterized.report.memory.fragments);
  }
}

// A build that looks at every block of triangles makes what one makes that leaves out those far from its bricks.
TEST_F(SmallTriangles, AreFoundByTheBlocksThatTheyLieIn) {
  Scene scene = manySizes();
  const VertexRange moving{600, 900};
  const Camera other = lookAt({1.5f, 1.2f, 2.0f}, {0, 0.1f, 0});
  const auto frames = [&](Scene moved) {
    std::vector<Frame> result;
    Renderer renderer = makeRenderer(moved);
    const Settings settings = settingsWith({});
    result.push_back(drawWith(renderer, kAbove, settings, 80, 60));
    result.push_back(drawWith(renderer, other, settings, 80, 60));
    for (std::uint32_t v = moving.first; v < moving.first + moving.count; ++v)
      moved.vertices[v].position = 0.9f * moved.vertices[v].position + glm::vec3(0, 0.1f, 0);
    renderer.updateVertices(moved, std::span(&moving, 1));
    result.push_back(drawWith(renderer, other, settings, 80, 60));
    return result;
  };
  const std::vector<Frame> some = frames(scene);
  std::vector<Frame> all;
  withShaders({{"tracing/identity/collect_blocks.comp", "maxBricks = 512.0", "maxBricks = -1.0"}},
              [&] { all = frames(scene); });
  ASSERT_EQ(all.size(), 3u);
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(some[i].layers.data, all[i].layers.data) << i;
    EXPECT_EQ(some[i].report.memory.fragments, all[i].report.memory.fragments) << i;
    EXPECT_EQ(some[i].report.memory.fragmentsStored, all[i].report.memory.fragmentsStored) << i;
  }
  EXPECT_GT(all[2].report.memory.fragments, all[1].report.memory.fragments);
  EXPECT_GT(all[1].report.memory.fragments, all[0].report.memory.fragments);
}

}  // namespace
}  // namespace halfsilver::testing
