#include "passes/accumulate.h"

#include "shared/passes/accumulate.h"

namespace halfsilver {

void AccumulatePass::run(const FrameView& view, Accumulation& out) {
  const GBuffer& gbuffer = view.gbuffer;
  if (!program_) program_ = gl::Program::compute(*api_, "passes/accumulate.comp");
  if (out.sum.shape().width != gbuffer.width || out.sum.shape().height != gbuffer.height || !out.sum) {
    out = {};  // the old memory goes before the new comes
    out.sum = gl::Texture(*api_, {.format = GL_RGBA32F, .width = gbuffer.width, .height = gbuffer.height}, "samples");
  }
  const auto section = view.profiler.section("composite");
  if (out.samples == 0) api_->ClearTexImage(out.sum.name(), 0, GL_RGBA, GL_FLOAT, nullptr);
  program_.use();
  view.bindPixelLight();
  out.sum.bindImage(IMAGE_SUM, GL_READ_WRITE);
  constexpr int kGroup = 8;
  api_->DispatchCompute(static_cast<GLuint>((gbuffer.width + kGroup - 1) / kGroup),
                        static_cast<GLuint>((gbuffer.height + kGroup - 1) / kGroup), 1);
  // The sum is read by the next sample and by the display.
  api_->MemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                      GL_TEXTURE_UPDATE_BARRIER_BIT);
  ++out.samples;
}

}  // namespace halfsilver
