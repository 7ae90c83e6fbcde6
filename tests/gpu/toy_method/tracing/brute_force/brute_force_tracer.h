#pragma once

#include <halfsilver/tracer.h>
#include "tracing/grid.h"
#include "tracing/trace_pass.h"

namespace halfsilver::testing {

// A toy: no structure, every ray tests every triangle.
class BruteForceTracer final : public Tracer {
 public:
  static Method method();  // the row of the table

  BruteForceTracer(const gl::Api& api, const Settings& settings);

  void update(const FrameView& view, const SceneChange& change) override;
  void trace(const FrameView& view, const RayQueue& rays, Hits& hits) override;
  TracerMemory memory() const override { return {}; }

 private:
  Grid grid_;
  TracePass tracePass_;
};

}  // namespace halfsilver::testing
