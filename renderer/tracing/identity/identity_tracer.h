#pragma once

#include "settings.h"
#include "tracing/grid.h"
#include "tracing/page_pool.h"
#include "tracing/trace_pass.h"
#include "tracing/tracer.h"
#include "tracing/voxel_pass.h"

namespace halfsilver {

// Fragments that name their triangle and its depth range over the texel (8 bytes); the exact ray/triangle test decides.
// Rasterization is conservative, so no candidate is missing and the result is exact at every resolution.
class IdentityTracer final : public Tracer {
 public:
  IdentityTracer(const gl::Api& api, const Settings& settings);

  void build(const GpuScene& scene, const RayQueue& rays, gl::Profiler& profiler) override;
  void trace(const GpuScene& scene, const RayQueue& rays, Hits& hits, gl::Profiler& profiler) override;
  TracerMemory memory() const override;
  std::uint64_t lostFragments() const override;

 private:
  const gl::Api* api_;
  int voxelResolution_, bufferResolution_, slabs_;
  bool ownAxis_;
  VoxelPass voxelPass_;
  gl::Program build_;
  TracePass tracePass_;
  gl::EmptyVertexArray vertexArray_;
  Grid grid_;
  Voxels voxels_;
  PagePool pool_;
  gl::Buffer entries_;
};

}  // namespace halfsilver
