// Small triangles, which one compute invocation each voxelizes, against the rasterizer.
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

#include "frame/gpu_scene.h"
#include "gpu/tracing_scenes.h"
#include "temporary_folder.h"
#include "tracing/voxel_pass.h"

namespace halfsilver::testing {
namespace {

namespace fs = std::filesystem;

class SmallTriangles : public TracingTest {
 protected:
  // Shaders for which no triangle is small, so that the rasterizer draws them all.
  SmallTriangles() {
    fs::copy(HALFSILVER_SOURCE_DIR "/shaders", rasterOnly_.path(), fs::copy_options::recursive);
    const fs::path file = rasterOnly_ / "shared/passes/listed_triangles.h";
    std::ifstream in(file);
    std::string text{std::istreambuf_iterator<char>(in), {}};
    const std::string limit = "#define SMALL_TEXELS 32";
    const std::size_t at = text.find(limit);
    EXPECT_NE(at, std::string::npos);
    text.replace(at, limit.size(), "#define SMALL_TEXELS 0");
    std::ofstream(file) << text;
  }

  void withRasterOnly(const std::function<void()>& work) const {
    ::setenv("HALFSILVER_SHADERS", rasterOnly_.path().c_str(), 1);
    work();
    ::unsetenv("HALFSILVER_SHADERS");
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

 private:
  TemporaryFolder rasterOnly_;
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
    const Frame mixed = drawOnce(scene, kAbove, settings, 80, 60);
    Frame raster;
    withRasterOnly([&] { raster = drawOnce(scene, kAbove, settings, 80, 60); });
    EXPECT_EQ(mixed.layers.data, raster.layers.data);
    const MemoryReport &a = mixed.report.memory, &b = raster.report.memory;
    EXPECT_GT(a.fragmentsStored, 1000u);
    EXPECT_EQ(a.fragments, b.fragments);
    EXPECT_EQ(a.fragmentsStored, b.fragmentsStored);
    EXPECT_EQ(a.heads, b.heads);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(a.fragmentsPerAxis[i], b.fragmentsPerAxis[i]) << i;
  }
}

}  // namespace
}  // namespace halfsilver::testing
