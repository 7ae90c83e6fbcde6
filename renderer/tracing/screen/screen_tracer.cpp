#include "tracing/screen/screen_tracer.h"

#include <memory>

#include "shared/passes/screen.h"

namespace halfsilver {
namespace {

constexpr int kGroup = 8;

int padded(int pixels) {
  constexpr int kLargest = 1 << (SCREEN_LEVELS - 1);
  return (pixels + kLargest - 1) / kLargest * kLargest;
}

}  // namespace

Method ScreenTracer::method() {
  return {{.name = "screen-space",
           .help = "what the screen shows, by a depth pyramid",
           .settings = {"trace.stage", "trace.count_work"}},
          [](const gl::Api& api, const Settings& settings) { return std::make_unique<ScreenTracer>(api, settings); }};
}

ScreenTracer::ScreenTracer(const gl::Api& api, const Settings& settings)
    : api_(&api),
      build_(gl::Program::compute(api, "tracing/screen/pyramid.comp")),
      tracePass_(api, settings.trace, "tracing/screen") {}

const ScreenTracer::Pyramid& ScreenTracer::pyramidOf(const GBuffer& gbuffer) const {
  const Pyramid& latest = pyramids_[latest_];
  return latest.of == &gbuffer ? latest : pyramids_[1 - latest_];
}

void ScreenTracer::update(const FrameView& view, const SceneChange&) {
  const auto scope = view.profiler.section("build");
  grid_ = makeGrid(view.scene.extents.bounds(), 1, 1);
  if (pyramids_[latest_].of != &view.gbuffer) latest_ = 1 - latest_;
  Pyramid& pyramid = pyramids_[latest_];
  pyramid.of = &view.gbuffer;
  const gl::Texture::Shape wanted{.format = GL_R32F,
                                  .width = padded(view.gbuffer.width),
                                  .height = padded(view.gbuffer.height),
                                  .levels = SCREEN_LEVELS};
  const gl::Texture::Shape& shape = pyramid.depths.shape();
  if (!pyramid.depths || shape.width != wanted.width || shape.height != wanted.height) {
    pyramid.depths = gl::Texture();  // the old memory goes before the new comes
    pyramid.depths = gl::Texture(*api_, wanted, "depth pyramid");
    pyramid.depths.parameter(GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_NEAREST);
  }
  build_.use();
  view.constants.bindUniform(UBO_FRAME);
  view.gbuffer.position.bind(UNIT_POSITION);
  pyramid.depths.bind(UNIT_SCREEN_DEPTHS);
  for (int level = 0; level < SCREEN_LEVELS; ++level) {
    build_.set("number", level);
    pyramid.depths.bindImage(IMAGE_SCREEN_DEPTHS, GL_WRITE_ONLY, level);
    const auto groups = [level](int size) { return static_cast<GLuint>(((size >> level) + kGroup - 1) / kGroup); };
    api_->DispatchCompute(groups(wanted.width), groups(wanted.height), 1);
    // A level is fetched by the next one's dispatch, and all by the trace.
    api_->MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  }
}

void ScreenTracer::trace(const FrameView& view, const RayQueue& rays, Hits& hits) {
  grid_.apply(tracePass_.program());
  const Pyramid& pyramid = pyramidOf(view.gbuffer);
  tracePass_.run(view, rays, hits, {[&pyramid] { pyramid.depths.bind(UNIT_SCREEN_DEPTHS); }});
}

TracerMemory ScreenTracer::memory() const {
  TracerMemory memory;
  for (const Pyramid& pyramid : pyramids_) memory.structureTotal += pyramid.depths.bytes();
  memory.transient = tracePass_.bytes();
  return memory;
}

}  // namespace halfsilver
