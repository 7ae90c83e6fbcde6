#include "tracing/screen/screen_tracer.h"

#include <memory>

namespace halfsilver {

Method ScreenTracer::method() {
  return {{.name = "screen-space",
           .help = "what the screen shows, by a depth pyramid",
           .settings = {"trace.stage", "trace.count_work"}},
          [](const gl::Api& api, const Settings& settings) { return std::make_unique<ScreenTracer>(api, settings); }};
}

ScreenTracer::ScreenTracer(const gl::Api& api, const Settings& settings)
    : pyramid_(api), tracePass_(api, settings.trace, "tracing/screen") {}

void ScreenTracer::update(const FrameView& view, const SceneChange&) {
  const auto scope = view.profiler.section("build");
  grid_ = makeGrid(view.scene.extents.bounds(), 1, 1);
  pyramid_.build(view);
}

void ScreenTracer::trace(const FrameView& view, const RayQueue& rays, Hits& hits) {
  grid_.apply(tracePass_.program());
  tracePass_.run(view, rays, hits, {[&] { pyramid_.bind(view); }});
}

TracerMemory ScreenTracer::memory() const {
  TracerMemory memory;
  memory.structureTotal = pyramid_.bytes();
  memory.transient = tracePass_.bytes();
  return memory;
}

}  // namespace halfsilver
