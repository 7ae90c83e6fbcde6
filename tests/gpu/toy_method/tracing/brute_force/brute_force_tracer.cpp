#include "gpu/toy_method/tracing/brute_force/brute_force_tracer.h"

namespace halfsilver::testing {

Method BruteForceTracer::method() {
  return {{.name = "brute_force", .help = "every ray tests every triangle", .settings = {"trace.stage"}},
          [](const gl::Api& api, const Settings& s) { return std::make_unique<BruteForceTracer>(api, s); }};
}

BruteForceTracer::BruteForceTracer(const gl::Api& api, const Settings& settings)
    : tracePass_(api, settings.trace, "tracing/brute_force") {}

void BruteForceTracer::update(const FrameView& view, const SceneChange&) {
  grid_ = makeGrid(view.scene.extents.bounds(), 1, 1);
}

void BruteForceTracer::trace(const FrameView& view, const RayQueue& rays, Hits& hits) {
  grid_.apply(tracePass_.program());
  tracePass_.program().set("triangleCount", view.scene.triangleCount);
  tracePass_.run(view, rays, hits, {[] {}});  // the scene's own buffers are all that it reads
}

}  // namespace halfsilver::testing
