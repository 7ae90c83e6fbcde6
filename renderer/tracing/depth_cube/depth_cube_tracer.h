#pragma once

#include <halfsilver/settings.h>
#include <halfsilver/tracer.h>
#include "tracing/depth_cube/depth_cube.h"
#include "tracing/grid.h"
#include "tracing/trace_pass.h"

namespace halfsilver {

// Rays through a layered depth cube: samples of all surfaces along three axes, of which a ray hits those that it passes
// within a tolerance. The cube is kept while no triangle moves.
// Source: Buerger, Hertel, Krueger & Westermann 2007.
class DepthCubeTracer final : public Tracer {
 public:
  static Method method();  // the row of the table

  DepthCubeTracer(const gl::Api& api, const Settings& settings);

  // Waits for the GPU once when it builds.
  void update(const FrameView& view, const SceneChange& change) override;
  void forget() override { built_ = false; }
  void trace(const FrameView& view, const RayQueue& rays, Hits& hits) override;
  bool storesAttributes() const override { return true; }
  TracerMemory memory() const override;
  const gl::Buffer* rayWork() const override { return tracePass_.work(); }
  TracerCounts counts() const override { return {&cube_.counters().buffer(), DepthCube::addCounts}; }

 private:
  Settings settings_;
  TracePass tracePass_;
  DepthCube cube_;
  Grid grid_;
  bool built_ = false;  // for the geometry and the materials of the last update
};

}  // namespace halfsilver
