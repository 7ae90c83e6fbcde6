#include "passes/interpolate.h"

#include "shared/passes/shade.h"

namespace halfsilver {

void InterpolatePass::run(const FrameView& view, const PrimarySettings& primary) {
  if (!program_) program_ = gl::Program::compute(*api_, "passes/interpolate.comp");
  const GBuffer& gbuffer = view.gbuffer;
  const auto section = view.profiler.section("composite");
  program_.use();
  // In its own row each pixel has one with a ray within half the distance of two of them.
  program_.set("reach", primary.every / 2 + 1);
  view.bindPixelLight();
  gbuffer.shaded.bindImage(IMAGE_SHADED, GL_WRITE_ONLY);
  constexpr int kGroup = 8;
  api_->DispatchCompute(static_cast<GLuint>((gbuffer.width + kGroup - 1) / kGroup),
                        static_cast<GLuint>((gbuffer.height + kGroup - 1) / kGroup), 1);
  // Colors (compute) of pixels that this dispatch does not read are fetched by the passes that show them.
  api_->MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
}

}  // namespace halfsilver
