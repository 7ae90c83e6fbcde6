#pragma once

#include <halfsilver/gl/profiler.h>
#include <halfsilver/products.h>
#include <halfsilver/settings.h>
#include "gl/framebuffer.h"
#include "gl/program.h"
#include "tracing/grid.h"
#include "tracing/listed_triangles.h"

namespace halfsilver {

// The coarse grid: occupied or not, and in which A-buffers a voxel's fragments are. Eight voxels per word.
struct Voxels {
  gl::Buffer words;
  gl::Buffer normalSums[3];  // while the dominant axis is chosen from sums of normals; empty for AxisRule::own
  gl::Buffer triangles;      // uint[voxels]: the lowest triangle in each, or NO_TRIANGLE; only if asked for

  std::size_t bytes() const;
  void bind() const;  // SSBO_VOXELS, SSBO_NORMAL_X to Z, SSBO_VOXEL_TRIANGLES
};

// Rasterizes the scene into the grid and chooses the dominant axes; see VoxelRaster and AxisRule.
// Sources: Crassin & Green 2012 (projection along the triangle's own axis), Hu et al. 2014, section 3.1, Kastrati &
// Goswami 2017, section 3.2.1; Hasselgren et al. 2005 (shifted edges).
class VoxelPass {
 public:
  // `triangles`: one triangle of each voxel is kept, too.
  VoxelPass(const gl::Api& api, VoxelRaster raster, AxisRule axis, bool triangles = false);

  // Section "voxelize". Ends with the grid readable by shaders.
  void run(const GpuScene& scene, gl::Profiler& profiler, const Grid& grid, Voxels& out);

  std::uint64_t transientBytes() const { return transient_; }  // while the last run() worked

 private:
  void rasterize(const GpuScene& scene, const Grid& grid, const Voxels& out);

  const gl::Api* api_;
  VoxelRaster raster_;
  AxisRule axis_;
  bool triangles_;
  gl::Program rasterize_;
  gl::Program small_;       // of VoxelRaster::conservative: small triangles
  gl::Program chooseAxis_;  // empty for AxisRule::own
  gl::EmptyVertexArray vertexArray_;
  ListedTriangles large_;
  std::uint64_t transient_ = 0;
};

}  // namespace halfsilver
