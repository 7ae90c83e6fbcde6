// Voxels of shifted edges against what the edges say, computed here.
#include <cmath>
#include <set>
#include <tuple>
#include <vector>

#include "frame/gpu_scene.h"
#include "gpu/tracing_scenes.h"
#include "shared/tracing.h"
#include "tracing/voxel_pass.h"

namespace halfsilver::testing {
namespace {

constexpr int kVoxels = 32;

class ShiftedEdges : public TracingTest {
 protected:
  using Cells = std::set<std::tuple<int, int, int>>;  // x, y, z

  Cells voxelize(const Scene& scene, VoxelRaster raster) {
    const GpuScene uploaded = uploadScene(api, scene);
    grid_ = makeGrid(uploaded.extents.bounds(), kVoxels, kVoxels);
    VoxelPass pass(api, raster, AxisRule::own);
    gl::Profiler profiler(api);
    Voxels voxels;
    pass.run(uploaded, profiler, grid_, voxels);
    api.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);  // marks (fragments) are read by the host
    const auto words = voxels.words.read<std::uint32_t>(voxels.words.bytes() / sizeof(std::uint32_t));
    Cells cells;
    for (std::size_t i = 0; i < grid_.voxelCount(); ++i)
      if (((words[i / VOXELS_PER_WORD] >> (VOXEL_BITS * (i % VOXELS_PER_WORD))) & 7u) != 0) {
        const glm::ivec3 at = grid_.voxelAt(i);
        cells.insert({at.x, at.y, at.z});
      }
    return cells;
  }

  // One triangle that lies flat enough to be seen along z, and two far specks that give the scene its size.
  static Scene oneTriangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    Scene scene;
    scene.materials = {plain({1, 1, 1})};
    addTriangle(scene, a, b, c, 0);
    addTriangle(scene, {0, 0, 0}, {0.001f, 0, 0}, {0, 0.001f, 0}, 0);
    addTriangle(scene, {1, 1, 1}, {0.999f, 1, 1}, {1, 0.999f, 1}, 0);
    return scene;
  }

  // Whether the triangle's projection along z touches the square around the texel's center, of half the side `reach`.
  bool touches(const std::vector<glm::dvec3>& corners, int x, int y, double reach) const {
    std::vector<glm::dvec2> p;
    for (const glm::dvec3& corner : corners) {
      const glm::dvec3 at = (corner - glm::dvec3(grid_.low)) / glm::dvec3(grid_.extent) * double(kVoxels);
      p.push_back(glm::dvec2(at) - glm::dvec2(x + 0.5, y + 0.5));
    }
    const auto separates = [&](const glm::dvec2& axis) {
      double low = 1e30, high = -1e30;
      for (const glm::dvec2& corner : p) {
        low = std::min(low, glm::dot(axis, corner));
        high = std::max(high, glm::dot(axis, corner));
      }
      const double square = reach * (std::abs(axis.x) + std::abs(axis.y));
      return low > square || high < -square;
    };
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::dvec2 edge = p[(i + 1) % 3] - p[i];
      if (separates({-edge.y, edge.x})) return false;
    }
    return !separates({1, 0}) && !separates({0, 1});
  }

  Grid grid_;
};

TEST_F(ShiftedEdges, MarkOneVoxelInEachColumnThatATriangleTouches) {
  const std::vector<std::vector<glm::dvec3>> triangles = {
      {{0.2, 0.15, 0.4}, {0.85, 0.3, 0.5}, {0.4, 0.8, 0.6}},        // ordinary
      {{0.1, 0.1, 0.5}, {0.9, 0.83, 0.5}, {0.9, 0.835, 0.5}},       // acute: its shifted edges meet far away
      {{0.31, 0.52, 0.5}, {0.312, 0.52, 0.5}, {0.31, 0.523, 0.5}},  // within a texel, far from its center
      {{0.85, 0.3, 0.5}, {0.2, 0.15, 0.4}, {0.4, 0.8, 0.6}},        // the other way round
  };
  for (std::size_t number = 0; number < triangles.size(); ++number) {
    const std::vector<glm::dvec3>& corners = triangles[number];
    const Scene scene = oneTriangle(corners[0], corners[1], corners[2]);
    const Cells shifted = voxelize(scene, VoxelRaster::shifted);
    const Cells conservative = voxelize(scene, VoxelRaster::conservative);
    const Cells plainly = voxelize(scene, VoxelRaster::voxel);
    std::vector<int> column(kVoxels * kVoxels);
    for (const auto& [x, y, z] : shifted) {
      EXPECT_TRUE(conservative.contains({x, y, z})) << number;
      if (z == 0 || z == kVoxels - 1) continue;  // the specks
      ++column[static_cast<std::size_t>(y * kVoxels + x)];
      EXPECT_TRUE(touches(corners, x, y, 0.51)) << number << ": " << x << " " << y;
    }
    int touched = 0;
    for (int y = 0; y < kVoxels; ++y)
      for (int x = 0; x < kVoxels; ++x) {
        const int marks = column[static_cast<std::size_t>(y * kVoxels + x)];
        EXPECT_LE(marks, 1) << number;
        if (!touches(corners, x, y, 0.49)) continue;
        ++touched;
        EXPECT_EQ(marks, 1) << number << ": " << x << " " << y;
      }
    EXPECT_GE(touched, 1) << number;
    EXPECT_GT(shifted.size(), plainly.size()) << number;
  }
}

}  // namespace
}  // namespace halfsilver::testing
