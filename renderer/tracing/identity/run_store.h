#pragma once

#include <span>

#include <halfsilver/settings.h>
#include <halfsilver/tracer.h>
#include "tracing/grid.h"
#include "tracing/identity/brick_work.h"
#include "tracing/identity/entry_layout.h"
#include "tracing/voxel_pass.h"

namespace halfsilver {

// The identity method's structure: a grid of bricks, each empty, missing or with its lists in one run of words; see
// shaders/tracing/identity/bricks.glsl. Owns all of its memory, lets it grow, and closes the gaps of runs given up.
//
// Runs are placed and given up on the GPU. What the host knows of them is what follow() was told last.
class RunStore {
 public:
  RunStore(const gl::Api& api, const Settings& settings);

  // Bricks for a scene, by its size and number of triangles. With `room` there is some around it, so that what moves
  // does not leave the grid at once.
  Grid brickGridOf(const GpuScene& scene, bool room) const;
  // Whether the grid that is there will do for the scene as it is now: holds it, and is not much too large.
  bool suits(const GpuScene& scene) const;

  // Triangles that reach beyond the grid: every ray tests them.
  void setOuter(std::span<const std::uint32_t> triangles);
  // Makes the grid and finds out which bricks are empty; the others are missing. Section "voxelize".
  void start(const FrameView& view, const Grid& bricks);
  // Drops all runs: the bricks that have triangles are missing. Reserves a pool for what rays may need, until fit().
  void forget(const GpuScene& scene);

  const Grid& grid() const { return grid_; }  // of voxels
  EntryLayout entryLayout() const { return entryLayout_; }
  const Grid& brickGrid() const { return brickGrid_; }
  std::uint32_t brickCount() const { return static_cast<std::uint32_t>(brickGrid_.voxelCount()); }
  bool ownAxis() const { return ownAxis_; }  // each triangle is in the A-buffer of its own dominant axis

  // Shrinks the empty cubes that empty bricks begin to those that are empty, near bricks that are not any more; to be
  // called after triangles have come to other bricks.
  void boundEmpty() const;

  // SSBO_VOXELS, SSBO_BRICKS, SSBO_RUNS and SSBO_BRICK_WORK.
  void bind() const;
  void bindOuter() const { outer_.bindStorage(SSBO_OUTER); }
  const gl::Buffer& work() const { return work_; }  // BrickWork

  // A copy of work(), made when no build was under way.
  void follow(const shared::BrickWork& work) { known_ = work; }
  // After follow(): RunBuilder::buildFew() has left requests, not for want of room.
  bool tooMany() const { return known_.heavyBricks > 0 || (known_.requestedBricks > 0 && known_.waitingWords == 0); }
  // After follow(): makes room if runs wait for it. False if the device has no more: they are lost. `besides` are the
  // bytes that a build holds meanwhile.
  bool makeRoom(std::uint64_t besides);
  // After follow(), when no more builds are to come: makes the pool as large as its runs, with a little headroom for
  // the next frame's; with more for structures that are kept while something moves, since the next frame will build as
  // much. Moves runs together if many words are stale.
  void fit(std::uint64_t besides, bool moving);

  bool complete() const { return lost_ == 0; }  // every build has found room
  // Many words are stale, and a run is too long for the device to move: better drop them all.
  bool stuck() const;

  StructureCells cells() const;             // waits for the GPU
  void report(TracerMemory& memory) const;  // all but fragments made
  void beginFrame() { transient_ = 0; }

 private:
  std::uint64_t capacity() const { return runs_.bytes() / sizeof(GLuint); }  // words
  std::uint64_t maxCapacity() const;
  bool sparse(double headroom) const;
  bool movable() const;
  void resizePool(std::uint64_t words, std::uint64_t besides);
  void compact(std::uint64_t words, std::uint64_t besides);
  void noteTransient(std::uint64_t bytes) { transient_ = std::max(transient_, bytes); }

  const gl::Api* api_;
  int resolution_;
  double voxelsPerTriangle_;
  bool ownAxis_;
  VoxelPass voxelPass_;
  gl::Program beginBricks_, beginBounding_, boundEmpty_, compactRuns_;

  Grid grid_, brickGrid_;
  EntryLayout entryLayout_;
  Voxels voxels_;  // of the brick grid
  gl::Buffer bricks_, runs_, outer_, work_;
  shared::BrickWork known_{};
  std::uint64_t fitted_ = 0;     // words of all runs at the last fit()
  std::uint64_t lost_ = 0;       // words that found no room
  std::uint64_t transient_ = 0;  // bytes, see TracerMemory
};

}  // namespace halfsilver
