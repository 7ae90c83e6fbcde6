#pragma once

#include <halfsilver/settings.h>
#include <halfsilver/tracer.h>
#include "gl/program.h"
#include "tracing/grid.h"
#include "tracing/trace_pass.h"
#include "tracing/voxel_pass.h"

namespace halfsilver {

// Voxels without anything finer: what Hu et al. 2014 (figure 9) hold against their own method, and what Papaioannou,
// Menexi & Papadopoulos 2010 trace for ambient occlusion. A ray hits the first occupied voxel on its way, so its hits
// are early by up to a voxel, and things are a voxel thick. Kept while no triangle moves.
class VoxelTracer final : public Tracer {
 public:
  static Method method();  // the row of the table

  VoxelTracer(const gl::Api& api, const Settings& settings);

  void update(const FrameView& view, const SceneChange& change) override;
  void forget() override { built_ = false; }
  void trace(const FrameView& view, const RayQueue& rays, Hits& hits) override;
  bool storesAttributes() const override { return true; }
  TracerMemory memory() const override;
  const gl::Buffer* rayWork() const override { return tracePass_.work(); }

 private:
  const gl::Api* api_;
  Settings settings_;
  VoxelPass voxelPass_;
  gl::Program settle_;
  TracePass tracePass_;
  Grid grid_;
  gl::Buffer triangles_;         // uint[voxels]
  gl::Buffer surfaces_;          // VoxelSurface[voxels]
  std::uint64_t transient_ = 0;  // of the last build
  bool built_ = false;           // for the geometry and the materials of the last update
};

}  // namespace halfsilver
