#pragma once

#include <span>
#include <string>

#include "gl/program.h"
#include "tracing/build_counters.h"
#include "tracing/identity/run_store.h"
#include "tracing/listed_triangles.h"

namespace halfsilver {

// Makes the runs that rays ask for. Triangles that may touch a requested brick are listed, and their voxels visited
// twice: to count the entries of each list, and, once the runs are placed, to fill them. The host learns nothing of it:
// every step is an indirect dispatch or draw, which does nothing if nothing is requested. Few bricks, as a move asks
// for, are built in one dispatch, a group for each, since so many steps would take longer than the work.
class RunBuilder {
 public:
  explicit RunBuilder(const gl::Api& api);

  // Bricks that rays may ask for until the next build: 66 words each while they are built in steps (4.3 MB).
  static constexpr std::uint32_t kMaxRequests = 16384;

  // Measures all triangles, for a store that has been started.
  void measure(const GpuScene& scene, const RunStore& store);
  // Makes room for requests in this frame.
  void begin(const RunStore& store);
  void bindRequests() const { requests_.bindStorage(SSBO_REQUESTS); }
  // Builds what has been requested since the last build. What finds no room in the store is missing again.
  void buildRequested(const GpuScene& scene, const RunStore& store);
  // The same in one step if it is little. If it is not, all requests, or those for bricks with very many triangles,
  // are left to buildRequested(); see RunStore::tooMany().
  void buildFew(const GpuScene& scene, const RunStore& store) const;

  // Gives up the bricks that moved triangles have come to, so that rays ask for them again. Those that they have left
  // can stay: the exact test sees where a triangle is now. The bricks that they came to at the last move are given up,
  // too, so that lists do not grow along an object's path.
  void followMoved(const GpuScene& scene, std::span<const VertexRange> moved, const RunStore& store);

  // Memory that is needed while a frame builds.
  std::uint64_t bytes() const { return triangles_.bytes() + requests_.bytes() + brickBuilds_.bytes(); }
  void releaseMemory();
  void beginFrame() { transient_ = 0; }

  const BuildCounters& counters() const { return counters_; }
  void clearCounters() { counters_.clear(); }
  void addMemory(TracerMemory& memory) const;

 private:
  void reserve(const GpuScene& scene, const RunStore& store);
  void visitBuilds(bool secondStep, const GpuScene& scene, const RunStore& store);
  void dispatchForBuilds(const gl::Program& program, std::size_t arguments, const RunStore& store) const;

  const gl::Api* api_;
  gl::Program boundBlocks_, beginBuild_, clearBuilds_, collectBlocks_, collectRequested_, sizeRuns_, placeRuns_,
      finishBricks_;
  gl::Program buildFew_;
  gl::Program buildSmall_, buildLarge_;
  gl::Program buildPaired_;                // large triangles in the few bricks of a small build
  gl::Program followMoved_, giveUpMoved_;  // made with the first move
  gl::Buffer step_;                        // BuildStep
  BuildCounters counters_;
  ListedTriangles triangles_;
  gl::Buffer requests_;          // BrickRequest[]
  gl::Buffer brickBuilds_;       // BrickBuild[]
  gl::Buffer blocks_;            // BoundedBlock[]
  std::uint64_t transient_ = 0;  // bytes, see TracerMemory
};

}  // namespace halfsilver
