#include "tracing/depth_pyramid.h"

#include <cstring>

#include "shared/passes/screen.h"

namespace halfsilver {
namespace {

constexpr int kGroup = 8;

int padded(int pixels) {
  constexpr int kLargest = 1 << (SCREEN_LEVELS - 1);
  return (pixels + kLargest - 1) / kLargest * kLargest;
}

}  // namespace

DepthPyramid::DepthPyramid(const gl::Api& api)
    : api_(&api), program_(gl::Program::compute(api, "tracing/common/pyramid.comp")) {}

bool DepthPyramid::holds(const FrameView& view) const {
  const OfFrame* const frame = frames_.find(view.gbuffer);
  return frame && frame->built &&
         // NOLINTNEXTLINE(*-memory-comparison): equal bytes are what is asked
         std::memcmp(&*frame->built, &view.frame, sizeof(shared::FrameConstants)) == 0;
}

void DepthPyramid::forget() {
  frames_.each([](OfFrame& frame) { frame.built.reset(); });
}

void DepthPyramid::build(const FrameView& view, const gl::Texture* backs) {
  OfFrame& frame = frames_.begin(view.gbuffer);
  frame.built.reset();  // until nothing has failed
  const gl::Texture::Shape wanted{.format = GL_R32F,
                                  .width = padded(view.gbuffer.width),
                                  .height = padded(view.gbuffer.height),
                                  .levels = SCREEN_LEVELS};
  const gl::Texture::Shape& shape = frame.depths.shape();
  if (!frame.depths || shape.width != wanted.width || shape.height != wanted.height) {
    frame.depths = gl::Texture();  // the old memory goes before the new comes
    frame.depths = gl::Texture(*api_, wanted, "depth pyramid");
    frame.depths.parameter(GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_NEAREST);
  }
  program_.use();
  program_.set("backsCount", backs ? 1 : 0);
  view.constants.bindUniform(UBO_FRAME);
  view.scene.bindTriangles();
  view.gbuffer.visibility.bind(UNIT_VISIBILITY);
  view.gbuffer.material.bind(UNIT_MATERIAL);
  (backs ? *backs : view.gbuffer.depth).bind(UNIT_BACK_DEPTHS);
  frame.depths.bind(UNIT_SCREEN_DEPTHS);
  for (int level = 0; level < SCREEN_LEVELS; ++level) {
    program_.set("number", level);
    frame.depths.bindImage(IMAGE_SCREEN_DEPTHS, GL_WRITE_ONLY, level);
    const auto groups = [level](int size) { return static_cast<GLuint>(((size >> level) + kGroup - 1) / kGroup); };
    api_->DispatchCompute(groups(wanted.width), groups(wanted.height), 1);
    // A level is fetched by the next one's dispatch, and all by the trace.
    api_->MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  }
  frame.built = view.frame;
}

void DepthPyramid::bind(const FrameView& view) const { frames_.of(view.gbuffer).depths.bind(UNIT_SCREEN_DEPTHS); }

std::uint64_t DepthPyramid::bytes() const {
  std::uint64_t sum = 0;
  frames_.each([&sum](const OfFrame& frame) { sum += frame.depths.bytes(); });
  return sum;
}

}  // namespace halfsilver
