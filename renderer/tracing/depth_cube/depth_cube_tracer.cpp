#include "tracing/depth_cube/depth_cube_tracer.h"

#include <algorithm>

namespace halfsilver {

Method DepthCubeTracer::method() {
  return {
      {.name = "depth-cube",
       .help = "layered depth images along three axes (Buerger et al. 2007)",
       .settings = {"abuffer.resolution", "cube.depth", "cube.axes", "cube.position", "cube.layers", "cube.block",
                    "cube.tolerance", "trace.stage", "trace.count_work"},
       .fixedResolution = true,
       .preset = "burger2007",
       .knobs = {{"cube.tolerance", {"0.0005", "0.001", "0.002"}}, {"abuffer.resolution", {"256", "512", "1024"}}}},
      [](const gl::Api& api, const Settings& settings) { return std::make_unique<DepthCubeTracer>(api, settings); }};
}

DepthCubeTracer::DepthCubeTracer(const gl::Api& api, const Settings& settings)
    : settings_(settings), tracePass_(api, settings.trace, "tracing/depth_cube"), cube_(api, settings) {}

void DepthCubeTracer::update(const FrameView& view, const SceneChange& change) {
  // What is stored of a surface is its color, too, and not where a material has holes.
  if (built_ && !change.geometry() && !change.materials) return;
  built_ = false;  // until nothing has failed
  grid_ = makeGrid(view.scene.extents.bounds(), 1, settings_.abuffer.resolution);
  cube_.build(view, grid_);
  built_ = true;
}

void DepthCubeTracer::trace(const FrameView& view, const RayQueue& rays, Hits& hits) {
  const gl::Program& program = tracePass_.program();
  grid_.apply(program);
  cube_.apply(program);
  program.set("tolerance", settings_.depthCube.tolerance * longestSide(grid_.extent));
  program.set("planes", settings_.depthCube.position == CubePosition::plane ? 1 : 0);
  program.set("texelSize", grid_.texelSize());
  tracePass_.run(view, rays, hits, {[this] { cube_.bind(); }});
}

TracerMemory DepthCubeTracer::memory() const {
  TracerMemory memory;
  cube_.report(memory);
  memory.transient = std::max(memory.transient, tracePass_.bytes());
  return memory;
}

}  // namespace halfsilver
