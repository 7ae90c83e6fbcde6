#pragma once

#include <array>
#include <vector>

#include <halfsilver/settings.h>
#include <halfsilver/tracer.h>
#include "tracing/identity/run_builder.h"
#include "tracing/identity/run_store.h"
#include "tracing/trace_pass.h"

namespace halfsilver {

// Fragments that name their triangle (4 bytes); the exact ray/triangle test decides. Rasterization is conservative, so
// no candidate is missing and the result is exact at every resolution.
//
// The A-buffers' texels and depths are the voxels', and lists are built on demand, a brick of voxels at a time: a ray
// that needs a brick asks for it and waits for the next dispatch. So the memory reserved is the memory used, and bricks
// that no ray needs cost a word each, and four bits of the coarse grid. Bricks stay until triangles move into them
// (IdentitySettings::keep).
//
// The GPU builds by itself; the host looks once per trace whether rays still wait and how much room runs need. A frame
// with the constants of the last one, in which nothing has changed, has the same rays: there it does not look at all.
class IdentityTracer final : public Tracer {
 public:
  static Method method();  // the row of the table

  IdentityTracer(const gl::Api& api, const Settings& settings);

  void update(const FrameView& view, const SceneChange& change) override;
  void forget() override { built_ = false; }
  void trace(const FrameView& view, const RayQueue& rays, Hits& hits) override;
  TracerMemory memory() const override;
  StructureCells cells() const override { return store_.cells(); }
  const gl::Buffer* rayWork() const override { return tracePass_.work(); }
  TracerCounts counts() const override { return {&builder_.counters().buffer(), addFragmentCounts}; }

 private:
  bool keep_;
  RunStore store_;
  RunBuilder builder_;
  gl::Program request_;
  TracePass tracePass_;
  bool built_ = false;  // for the geometry of the last update

  // Of the last frames. Those under way are known by the buffer of their constants.
  struct Traces {
    const gl::Buffer* constants = nullptr;
    shared::FrameConstants frame{};
    std::size_t count = 0;        // so far
    std::vector<int> dispatches;  // of each trace, that had something to do; 0: the structure has changed since
  };
  std::array<Traces, 4> traces_;
  std::size_t latest_ = 0;  // the frame begun last

  int dispatchesToLook_ = 0;  // see TracePass::Structure
  int firstLookAhead_ = 0;    // bricks
  bool few_ = false;          // rays ask for few bricks: most are there
  bool kept_ = false;         // the structure is that of the last frame, for another view or with triangles moved
};

}  // namespace halfsilver
