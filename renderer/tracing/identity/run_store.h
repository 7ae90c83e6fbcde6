#pragma once

#include <optional>
#include <span>

#include <halfsilver/gl/readback.h>
#include <halfsilver/settings.h>
#include <halfsilver/tracer.h>
#include "tracing/grid.h"
#include "tracing/identity/brick_work.h"
#include "tracing/identity/prefix_sum.h"
#include "tracing/voxel_pass.h"

namespace halfsilver {

// The identity method's structure: a grid of bricks, each empty, missing or with its lists in one run of words; see
// shaders/tracing/identity/bricks.glsl. Owns all of its memory, lets it grow, and closes the gaps of runs given up.
class RunStore {
 public:
  RunStore(const gl::Api& api, const Settings& settings);

  // Bricks for a scene, by its size and number of triangles.
  Grid brickGridOf(const GpuScene& scene) const;

  // Triangles that reach beyond the grid: every ray tests them.
  void setOuter(std::span<const std::uint32_t> triangles);
  // Makes the grid and finds out which bricks are empty; the others are missing. Section "voxelize".
  void start(const FrameView& view, const Grid& bricks);
  // Drops all runs: the bricks that have triangles are missing.
  void forget();

  const Grid& grid() const { return grid_; }  // of voxels
  const Grid& brickGrid() const { return brickGrid_; }
  std::uint32_t brickCount() const { return static_cast<std::uint32_t>(brickGrid_.voxelCount()); }
  bool ownAxis() const { return ownAxis_; }  // each triangle is in the A-buffer of its own dominant axis

  // SSBO_VOXELS, SSBO_BRICKS, SSBO_RUNS and SSBO_BRICK_WORK.
  void bind() const;
  void bindOuter() const { outer_.bindStorage(SSBO_OUTER); }

  // Requests and counts, which shaders write.
  const gl::Buffer& work() const { return work_; }
  void clearWork();
  shared::BrickWork readWork();  // waits for the GPU

  // Room behind the runs that are there: its first word, or nothing if the device has no more. `besides` are the bytes
  // that a build holds meanwhile.
  std::optional<std::uint32_t> makeRoom(std::uint64_t words, std::uint64_t besides);
  void addBuilt(const shared::BrickWork& work);
  void addLost(std::uint64_t words) { lost_ += words; }
  void addStale(const shared::BrickWork& work);
  bool complete() const { return lost_ == 0; }  // every build has found room

  // Moves runs together if many words are stale. False if a run is too long for that: then all are dropped.
  bool compact(std::uint64_t besides);
  // Gives back what an earlier geometry needed if this one needs nothing.
  void shrink();

  void report(TracerMemory& memory) const;  // all but fragments made
  void beginFrame() { transient_ = 0; }

 private:
  std::uint64_t capacity() const { return runs_.bytes() / sizeof(GLuint); }  // words
  void noteTransient(std::uint64_t bytes) { transient_ = std::max(transient_, bytes); }

  const gl::Api* api_;
  int resolution_;
  double voxelsPerTriangle_;
  bool ownAxis_;
  VoxelPass voxelPass_;
  gl::Program beginBricks_;
  std::optional<PrefixSum> compactSum_;  // made when it is first needed
  gl::BlockingRead read_;

  Grid grid_, brickGrid_;
  Voxels voxels_;  // of the brick grid
  gl::Buffer bricks_, runs_, outer_, work_;
  // Words.
  std::uint64_t used_ = 0;              // in runs
  std::uint64_t headerWords_ = 0;       // of those, before the entries
  std::uint64_t staleWords_ = 0;        // in runs that were given up
  std::uint64_t staleHeaderWords_ = 0;  // of those, before the entries
  std::uint64_t longestRun_ = 0;
  std::uint64_t lost_ = 0;       // that found no room
  std::uint64_t transient_ = 0;  // bytes, see TracerMemory
};

}  // namespace halfsilver
