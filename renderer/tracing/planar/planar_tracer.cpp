#include "tracing/planar/planar_tracer.h"

#include <cstddef>
#include <memory>

#include <halfsilver/shared_structs.h>

namespace halfsilver {
namespace shared {

#include "shared/passes/captures.h"

static_assert(offsetof(MirrorPlanes, chosen) == 0);  // a uniform block begins here
static_assert(offsetof(MirrorPlanes, votes) == 16 * (1 + PLANE_CANDIDATES));
static_assert(sizeof(MirrorPlanes) == 16 * (1 + PLANE_CANDIDATES) + 4 * PLANE_CANDIDATES);

}  // namespace shared

Method PlanarTracer::method() {
  return {{.name = "planar",
           .help = "the scene mirrored at one plane, the one of most reflecting pixels",
           .settings = {"trace.stage", "trace.count_work"}},
          [](const gl::Api& api, const Settings& settings) { return std::make_unique<PlanarTracer>(api, settings); }};
}

PlanarTracer::PlanarTracer(const gl::Api& api, const Settings& settings)
    : api_(&api),
      choose_(gl::Program::compute(api, "tracing/planar/choose_plane.comp")),
      settle_(gl::Program::compute(api, "tracing/planar/settle_plane.comp")),
      draw_(api, "tracing/planar/mirrored.vert", "tracing/planar/mirrored.frag"),
      tracePass_(api, settings.trace, "tracing/planar") {
  frames_.each(
      [&api](Mirrored& frame) { frame.planes = gl::Buffer(api, sizeof(shared::MirrorPlanes), "mirror planes"); });
}

void PlanarTracer::choosePlane(const FrameView& view, const gl::Buffer& planes) const {
  view.constants.bindUniform(UBO_FRAME);
  view.scene.bindTriangles();
  view.gbuffer.normal.bind(UNIT_NORMAL);
  view.gbuffer.visibility.bind(UNIT_VISIBILITY);
  planes.bindStorage(SSBO_PLANES);
  choose_.use();
  api_->DispatchCompute(PLANE_CANDIDATES, 1, 1);
  // Votes (choose) are counted.
  api_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  settle_.use();
  api_->DispatchCompute(1, 1, 1);
  // The plane is drawn with, and traced.
  api_->MemoryBarrier(GL_UNIFORM_BARRIER_BIT);
}

void PlanarTracer::update(const FrameView& view, const SceneChange&) {
  const auto scope = view.profiler.section("build");
  grid_ = makeGrid(view.scene.extents.bounds(), 1, 1);
  Mirrored& frame = frames_.begin(view.gbuffer);
  const int width = view.gbuffer.width, height = view.gbuffer.height;
  const auto fit = [&](GLenum format, const char* label, gl::Texture& texture) {
    if (texture && texture.shape().width == width && texture.shape().height == height) return;
    texture = gl::Texture();  // the old memory goes before the new comes
    texture = gl::Texture(*api_, {.format = format, .width = width, .height = height}, label);
  };
  fit(GL_R32UI, "mirrored triangles", frame.image);
  fit(GL_DEPTH_COMPONENT32F, "mirrored depth", depth_);
  choosePlane(view, frame.planes);
  frame.planes.bindUniform(UBO_PLANE);
  draw_.run(view, {.image = frame.image, .depth = depth_, .mirrored = true});
}

void PlanarTracer::trace(const FrameView& view, const RayQueue& rays, Hits& hits) {
  grid_.apply(tracePass_.program());
  const Mirrored& frame = frames_.of(view.gbuffer);
  tracePass_.run(view, rays, hits,
                 {.bind =
                      [&frame] {
                        frame.planes.bindUniform(UBO_PLANE);
                        frame.image.bind(UNIT_CAPTURE);
                      },
                  .certain = true});
}

TracerMemory PlanarTracer::memory() const {
  TracerMemory memory;
  memory.structureTotal = depth_.bytes();
  frames_.each(
      [&memory](const Mirrored& frame) { memory.structureTotal += frame.planes.bytes() + frame.image.bytes(); });
  memory.transient = tracePass_.bytes();
  return memory;
}

}  // namespace halfsilver
