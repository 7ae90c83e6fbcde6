#include "tracing/cubemap/cubemap_tracer.h"

#include <glm/glm.hpp>
#include <memory>

#include <halfsilver/shared_structs.h>

namespace halfsilver {
namespace shared {

#include "shared/passes/captures.h"

}  // namespace shared

namespace {

constexpr int kFaces = 6;

}  // namespace

Method CubemapTracer::method() {
  return {{.name = "cubemap",
           .help = "a cube captured before the reflecting surfaces, looked up by direction",
           .settings = {"abuffer.resolution", "trace.stage", "trace.count_work"}},
          [](const gl::Api& api, const Settings& settings) { return std::make_unique<CubemapTracer>(api, settings); }};
}

CubemapTracer::CubemapTracer(const gl::Api& api, const Settings& settings)
    : api_(&api),
      resolution_(settings.abuffer.resolution),
      place_(gl::Program::compute(api, "tracing/cubemap/place_probe.comp")),
      draw_(api, "tracing/cubemap/capture.vert", "tracing/cubemap/capture.frag"),
      tracePass_(api, settings.trace, "tracing/cubemap") {
  const gl::Texture::Shape depth{.format = GL_DEPTH_COMPONENT32F, .width = resolution_, .height = resolution_};
  gl::Texture::Shape faces{.target = GL_TEXTURE_2D_ARRAY, .format = GL_R32UI, .width = resolution_};
  faces.height = resolution_;
  faces.depth = kFaces;
  depth_ = gl::Texture(api, depth, "cube depth");
  frames_.each([&](Cube& frame) {
    frame.probe = gl::Buffer(api, sizeof(glm::vec4), "probe");
    frame.faces = gl::Texture(api, faces, "cube of triangles");
  });
}

void CubemapTracer::placeProbe(const FrameView& view, const gl::Buffer& probe) const {
  view.constants.bindUniform(UBO_FRAME);
  view.scene.bindTriangles();
  view.gbuffer.normal.bind(UNIT_NORMAL);
  view.gbuffer.visibility.bind(UNIT_VISIBILITY);
  probe.bindStorage(SSBO_PROBE);
  place_.use();
  api_->DispatchCompute(1, 1, 1);
  // The probe's place is drawn with, and traced.
  api_->MemoryBarrier(GL_UNIFORM_BARRIER_BIT);
}

void CubemapTracer::update(const FrameView& view, const SceneChange&) {
  const auto scope = view.profiler.section("build");
  grid_ = makeGrid(view.scene.extents.bounds(), 1, 1);
  Cube& frame = frames_.begin(view.gbuffer);
  placeProbe(view, frame.probe);
  frame.probe.bindUniform(UBO_PROBE);
  for (int face = 0; face < kFaces; ++face)
    // The pictures of the first three faces are mirror images.
    draw_.run(view, {.image = frame.faces, .depth = depth_, .layer = face, .mirrored = face < kFaces / 2},
              [&](const gl::Program& program) {
                program.set("face", face);
                program.set("resolution", resolution_);
              });
}

void CubemapTracer::trace(const FrameView& view, const RayQueue& rays, Hits& hits) {
  grid_.apply(tracePass_.program());
  const Cube& frame = frames_.of(view.gbuffer);
  tracePass_.run(view, rays, hits,
                 {.bind =
                      [&frame] {
                        frame.probe.bindUniform(UBO_PROBE);
                        frame.faces.bind(UNIT_CAPTURE);
                      },
                  .certain = true});
}

TracerMemory CubemapTracer::memory() const {
  TracerMemory memory;
  memory.structureTotal = depth_.bytes();
  frames_.each([&memory](const Cube& frame) { memory.structureTotal += frame.probe.bytes() + frame.faces.bytes(); });
  memory.transient = tracePass_.bytes();
  return memory;
}

}  // namespace halfsilver
