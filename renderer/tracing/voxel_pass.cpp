#include "tracing/voxel_pass.h"

#include <vector>

#include "shared/passes/voxelize.h"
#include "shared/tracing.h"
#include "tracing/raster.h"

namespace halfsilver {
namespace {

std::vector<gl::Define> rasterDefines(VoxelRaster raster, AxisRule axis, bool triangles) {
  std::vector<gl::Define> defines;
  if (raster == VoxelRaster::conservative) defines.push_back({"CONSERVATIVE"});
  if (raster == VoxelRaster::shifted) defines.push_back({"SHIFTED"});
  if (axis != AxisRule::own) defines.push_back({"ACCUMULATE"});
  if (triangles) defines.push_back({"KEEP_TRIANGLES"});
  return defines;
}

}  // namespace

std::size_t Voxels::bytes() const {
  return words.bytes() + normalSums[0].bytes() + normalSums[1].bytes() + normalSums[2].bytes() + triangles.bytes();
}

void Voxels::bind() const {
  words.bindStorage(SSBO_VOXELS);
  for (GLuint i = 0; i < 3; ++i)
    if (normalSums[i]) normalSums[i].bindStorage(SSBO_NORMAL_X + i);
  if (triangles) triangles.bindStorage(SSBO_VOXEL_TRIANGLES);
}

VoxelPass::VoxelPass(const gl::Api& api, VoxelRaster raster, AxisRule axis, bool triangles)
    : api_(&api),
      raster_(raster),
      axis_(axis),
      triangles_(triangles),
      rasterize_(gl::Program::raster(
          api,
          raster == VoxelRaster::conservative ? "tracing/common/large_triangles.vert" : "tracing/common/voxelize.vert",
          "tracing/common/voxelize.frag", rasterDefines(raster, axis, triangles))),
      vertexArray_(api),
      large_(api) {
  if (raster == VoxelRaster::conservative)
    small_ = gl::Program::compute(api, "tracing/common/voxelize_small.comp", rasterDefines(raster, axis, triangles));
  if (axis != AxisRule::own && !triangles) chooseAxis_ = gl::Program::compute(api, "tracing/common/voxel_axis.comp");
}

void VoxelPass::run(const GpuScene& scene, gl::Profiler& profiler, const Grid& grid, Voxels& out) {
  const auto scope = profiler.section("voxelize");
  const std::size_t words = (grid.voxelCount() + VOXELS_PER_WORD - 1) / VOXELS_PER_WORD;
  if (out.words.bytes() != words * sizeof(GLuint)) out.words = gl::Buffer(*api_, words * sizeof(GLuint), "voxel grid");
  out.words.fill(0);
  if (axis_ != AxisRule::own) {
    const std::size_t bytes = words * VOXELS_PER_WORD * sizeof(GLint);
    for (GLuint i = 0; i < 3; ++i) {
      if (out.normalSums[i].bytes() != bytes) out.normalSums[i] = gl::Buffer(*api_, bytes, "sum of normals");
      out.normalSums[i].fill(0);
    }
  }
  if (triangles_) {
    const std::size_t bytes = grid.voxelCount() * sizeof(GLuint);
    if (out.triangles.bytes() != bytes) out.triangles = gl::Buffer(*api_, bytes, "triangles of voxels");
    out.triangles.fill(NO_TRIANGLE);
  }
  // Clears of buffers come before the fragments' atomics.
  api_->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);

  rasterize(scene, grid, out);
  // Marks and sums (shaders) are read by the choice of axes, the build and the trace.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  if (!chooseAxis_) return;

  grid.apply(chooseAxis_);
  chooseAxis_.set("wordCount", static_cast<GLuint>(words));
  out.bind();
  dispatchFor(*api_, chooseAxis_, words);
  // The axes (compute) are read by the build and the trace.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void VoxelPass::rasterize(const GpuScene& scene, const Grid& grid, const Voxels& out) {
  // The raster of Hu et al. is that of the three A-buffers, so all three projections vote; the others project each
  // triangle along its own axis, as do masks of own axes whatever the raster.
  const bool allProjections = raster_ == VoxelRaster::abuffer && axis_ != AxisRule::own;
  const int resolution = raster_ == VoxelRaster::abuffer ? grid.texels : grid.longestSide();
  const auto apply = [&](const gl::Program& program) {
    grid.apply(program);
    program.set("ownAxis", allProjections ? 0 : 1);
    program.set("absoluteNormals", axis_ == AxisRule::area ? 1 : 0);
  };
  apply(rasterize_);
  out.bind();
  if (small_) {
    apply(small_);
    large_.begin(scene, true);
    transient_ = large_.bytes();
    // Marks and sums are atomic, so the rasterizer need not wait for them.
    large_.choose(small_, scene, scene.triangleCount);
    large_.rasterizeLarge(rasterize_, resolution);
    large_.releaseMemory();
  } else {
    rasterize_.set("rasterResolution", resolution);
    scene.bindTriangles();
    rasterizeScene(*api_, rasterize_, vertexArray_, scene,
                   {.resolution = resolution, .projections = allProjections ? 3 : 1});
  }
}

}  // namespace halfsilver
