#pragma once

#include <halfsilver/gl/texel_buffer.h>
#include <halfsilver/settings.h>
#include <halfsilver/tracer.h>
#include "gl/framebuffer.h"
#include "tracing/attributes/page_pool.h"
#include "tracing/grid.h"
#include "tracing/trace_pass.h"
#include "tracing/voxel_pass.h"

namespace halfsilver {

// The published methods: fragments with all surface attributes (32 bytes), found by comparing depths along the ray.
// Buffers::three stores every fragment in every projection (Hu et al. 2014), Buffers::single only in the A-buffer of
// its voxel's dominant axis (Kastrati & Goswami 2017).
class AttributeTracer final : public Tracer {
 public:
  static Method method();  // the row of the table

  // Throws Error (badInput) for settings that do not go together.
  AttributeTracer(const gl::Api& api, const Settings& settings);

  void update(const FrameView& view, const SceneChange& change) override;
  void trace(const FrameView& view, const RayQueue& rays, Hits& hits) override;
  void occluded(const FrameView& view, const RayQueue& rays, Hits& hits) override;
  bool storesAttributes() const override { return true; }
  TracerMemory memory() const override;
  StructureCells cells() const override;
  const gl::Buffer* rayWork() const override { return tracePass_.work(); }
  TracerCounts counts() const override { return {&pool_.counters().buffer(), PagePool::addCounts}; }

 private:
  void sortLists();
  void search(const FrameView& view, const RayQueue& rays, const Hits& hits, int refinements);

  const gl::Api* api_;
  Settings settings_;
  VoxelPass voxelPass_;
  gl::Program build_;
  gl::Program sort_;  // empty unless lists are sorted
  TracePass tracePass_;
  gl::EmptyVertexArray vertexArray_;
  Grid grid_;
  Voxels voxels_;
  PagePool pool_;
  gl::TexelBuffer entries_;
};

}  // namespace halfsilver
