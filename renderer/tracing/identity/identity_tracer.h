#pragma once

#include <optional>

#include <halfsilver/settings.h>
#include <halfsilver/tracer.h>
#include "gl/framebuffer.h"
#include "tracing/build_counters.h"
#include "tracing/grid.h"
#include "tracing/identity/prefix_sum.h"
#include "tracing/trace_pass.h"
#include "tracing/voxel_pass.h"

namespace halfsilver {

// Fragments that name their triangle (4 bytes); the exact ray/triangle test decides. Rasterization is conservative, so
// no candidate is missing and the result is exact at every resolution.
//
// The A-buffers' texels and depths are the voxels', and lists are built on demand, a brick of voxels at a time: a ray
// that needs a brick asks for it and waits. What is asked for is counted, placed and filled in two passes over the
// triangles that touch it, so the memory reserved is the memory used, and bricks that no ray needs cost a word each,
// and four bits of the coarse grid.
// Bricks stay until triangles move into them (IdentitySettings::keep).
class IdentityTracer final : public Tracer {
 public:
  static Method method();  // the row of the table

  IdentityTracer(const gl::Api& api, const Settings& settings);

  void update(const FrameView& view, const SceneChange& change) override;
  void forget() override { built_ = false; }
  void trace(const FrameView& view, const RayQueue& rays, Hits& hits) override;
  TracerMemory memory() const override;
  TracerCounts counts() const override { return {&counters_.buffer(), addFragmentCounts}; }

 private:
  void forgetBricks();
  void followMove(const GpuScene& scene, std::span<const VertexRange> moved);
  void compact();
  void clearListBuild();
  void collect(const gl::Program& program, const GpuScene& scene);
  void bindStructure() const;
  // Builds the bricks that rays have asked for. False where they find no room.
  bool buildRequested(const GpuScene& scene);
  void rasterizeCandidates(const gl::Program& program, const Grid& raster, const GpuScene& scene);
  std::uint32_t brickCount() const { return static_cast<std::uint32_t>(brickGrid_.voxelCount()); }
  bool makeRoom(std::uint64_t more);
  std::uint64_t capacity() const;
  void noteTransient(std::uint64_t more);

  const gl::Api* api_;
  int resolution_;
  double perTriangle_;
  bool ownAxis_, keep_;
  VoxelPass voxelPass_;
  PrefixSum placeSum_;
  gl::Program setStates_, cull_, build_, finish_;
  // Made with the first move.
  gl::Program collectMoved_, move_, leave_;
  std::optional<PrefixSum> compactSum_;
  TracePass tracePass_;
  gl::EmptyVertexArray vertexArray_;

  Grid grid_, brickGrid_;
  Voxels voxels_;  // of the brick grid
  gl::Buffer bricks_, runs_, listBuild_;
  gl::Buffer outer_;                     // triangles that reach beyond the grid: their count, then their numbers
  gl::Buffer candidates_, brickBuilds_;  // while a frame builds
  BuildCounters counters_;
  int firstLookAhead_ = 0;  // of this frame's rays, bricks
  bool built_ = false;      // for the geometry of the last update
  // Words.
  std::uint64_t used_ = 0;          // in runs
  std::uint64_t headers_ = 0;       // of those, before the entries
  std::uint64_t stale_ = 0;         // in runs that were given up
  std::uint64_t staleHeaders_ = 0;  // of those, before the entries
  std::uint64_t longest_ = 0;       // of the longest run
  std::uint64_t lost_ = 0;          // that found no room
  std::uint64_t transient_ = 0;     // bytes, see TracerMemory
};

}  // namespace halfsilver
