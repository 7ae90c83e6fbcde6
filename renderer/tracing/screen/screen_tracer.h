#pragma once

#include <halfsilver/settings.h>
#include <halfsilver/tracer.h>
#include "tracing/depth_pyramid.h"
#include "tracing/grid.h"
#include "tracing/trace_pass.h"

namespace halfsilver {

// Rays through what the screen shows (McGuire & Mara 2014, "Efficient GPU Screen-Space Ray Tracing", in steps of a
// depth pyramid): what most games do. It builds nothing but the pyramid, and knows nothing of what the camera does not
// see: a ray that leaves the screen misses, one that passes behind what is seen hits what is seen later or misses.
//
// Unlike those it needs no thickness: a pixel names its triangle, and the ray is tested against it.
class ScreenTracer final : public Tracer {
 public:
  static Method method();  // the row of the table

  ScreenTracer(const gl::Api& api, const Settings& settings);

  // Section "build": the pyramid of this frame's depths.
  void update(const FrameView& view, const SceneChange& change) override;
  void trace(const FrameView& view, const RayQueue& rays, Hits& hits) override;
  bool seesBehind() const override { return false; }
  TracerMemory memory() const override;
  const gl::Buffer* rayWork() const override { return tracePass_.work(); }

 private:
  DepthPyramid pyramid_;
  TracePass tracePass_;
  Grid grid_;  // the bounds alone: rays begin and end there
};

}  // namespace halfsilver
