#pragma once

#include <optional>

#include "settings.h"
#include "tracing/build_counters.h"
#include "tracing/grid.h"
#include "tracing/identity/prefix_sum.h"
#include "tracing/trace_pass.h"
#include "tracing/tracer.h"
#include "tracing/voxel_pass.h"

namespace halfsilver {

// Fragments that name their triangle (4 bytes); the exact ray/triangle test decides. Rasterization is conservative, so
// no candidate is missing and the result is exact at every resolution.
//
// The A-buffers' texels and depths are the voxels', and lists are built on demand: a ray that needs the list of a voxel
// asks for it and waits. What is asked for is counted, placed and filled in two passes over the triangles that touch
// it, so the memory reserved is the memory used. Lists stay until triangles move into their voxels
// (ABufferSettings::keep).
class IdentityTracer final : public Tracer {
 public:
  IdentityTracer(const gl::Api& api, const Settings& settings);

  void build(const GpuScene& scene, const RayQueue& rays, gl::Profiler& profiler) override;
  void trace(const GpuScene& scene, const RayQueue& rays, Hits& hits, gl::Profiler& profiler) override;
  TracerMemory memory() const override;
  std::uint64_t lostFragments() const override { return lost_; }

 private:
  void numberLists();
  void followMove(const GpuScene& scene);
  void renumber(const gl::Buffer& oldWords);
  void compact();
  gl::Buffer copyOf(const gl::Buffer& buffer) const;
  void clearListBuild();
  void collect(const gl::Program& program, const GpuScene& scene);
  void bindStructure() const;
  // Builds the lists that rays have asked for. False where they find no room.
  bool buildRequested(const GpuScene& scene);
  void rasterizeCandidates(const gl::Program& program, int step, const GpuScene& scene);
  bool makeRoom(std::uint64_t more);
  std::uint64_t capacity() const;

  const gl::Api* api_;
  int resolution_;
  double perTriangle_;
  bool ownAxis_, keep_;
  VoxelPass voxelPass_;
  PrefixSum rankSum_, placeSum_;
  gl::Program cull_, build_;
  // Made with the first move.
  gl::Program collectMoved_, move_, renumber_;
  std::optional<PrefixSum> compactSum_;
  TracePass tracePass_;
  gl::EmptyVertexArray vertexArray_;

  Grid grid_;
  Voxels voxels_;
  gl::Buffer ranks_, heads_, entries_, requested_, listBuild_, candidates_;
  BuildCounters counters_;
  std::optional<std::uint32_t> geometry_;  // of what is built; none: nothing is
  std::uint32_t lists_ = 0;
  std::uint32_t longest_ = 0;  // entries of the longest list
  std::uint64_t used_ = 0;     // entries
  std::uint64_t stale_ = 0;    // of those, in lists that have been built anew since
  std::uint64_t lost_ = 0;     // entries that found no room
};

}  // namespace halfsilver
