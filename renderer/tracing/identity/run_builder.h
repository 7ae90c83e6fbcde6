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
// every step is an indirect dispatch or draw, which does nothing if nothing is requested.
class RunBuilder {
 public:
  explicit RunBuilder(const gl::Api& api);

  // Bricks that rays may ask for until the next build: 66 words each while they are built (4.3 MB).
  static constexpr std::uint32_t kMaxRequests = 16384;

  // Measures all triangles, for a store that has been started.
  void measure(const GpuScene& scene, const RunStore& store);
  // Makes room for builds in this frame.
  void begin(const GpuScene& scene, const RunStore& store);
  // Builds what has been requested since the last call. What finds no room in the store is missing again.
  void buildRequested(const GpuScene& scene, const RunStore& store);

  // Gives up the bricks that moved triangles have come to, so that rays ask for them again. Those that they have left
  // can stay: the exact test sees where a triangle is now. The bricks that they came to at the last move are given up,
  // too, so that lists do not grow along an object's path.
  void giveUpMoved(const GpuScene& scene, std::span<const VertexRange> moved, const RunStore& store);

  // Memory that is needed while a frame builds.
  std::uint64_t bytes() const { return triangles_.bytes() + brickBuilds_.bytes(); }
  void releaseMemory();
  void beginFrame() { transient_ = 0; }

  const BuildCounters& counters() const { return counters_; }
  void clearCounters() { counters_.clear(); }
  void addMemory(TracerMemory& memory) const;

 private:
  // What becomes of the voxels that the listed triangles touch.
  struct Visit {
    gl::Program small, large;
  };
  static Visit makeVisit(const gl::Api& api, const std::string& name, std::span<const gl::Define> defines = {});

  void measure(std::size_t blocks, const GpuScene& scene, const RunStore& store) const;
  void visit(const Visit& programs, const Grid& grid, const GpuScene& scene, const RunStore& store) const;
  void visitBuilds(bool secondStep, const GpuScene& scene, const RunStore& store);
  void dispatchForBuilds(const gl::Program& program, std::size_t arguments, const RunStore& store) const;

  const gl::Api* api_;
  gl::Program boundBlocks_, beginBuild_, listRequested_, collectBlocks_, collectRequested_, sizeRuns_, placeRuns_,
      finishBricks_;
  Visit build_;
  gl::Program buildPaired_;                 // large triangles in the few bricks of a small build
  gl::Program collectMoved_, giveUpMoved_;  // made with the first move
  Visit markMoved_;                         // likewise
  gl::Buffer step_;                         // BuildStep
  BuildCounters counters_;
  ListedTriangles triangles_;
  gl::Buffer brickBuilds_;
  gl::Buffer blocks_;            // BoundedBlock[]
  std::uint64_t transient_ = 0;  // bytes, see TracerMemory
};

}  // namespace halfsilver
