#include "passes/temporal.h"

#include <vector>

#include "shared/passes/motion.h"
#include "shared/passes/temporal.h"

namespace halfsilver {
void TemporalPass::begin(const FrameView& view) {
  const int width = view.gbuffer.width, height = view.gbuffer.height;
  if (!motion_ || motion_.shape().width != width || motion_.shape().height != height) {
    forget();  // the old memory goes before the new comes
    const auto texture = [&](GLenum format, const char* label) {
      return gl::Texture(*api_, {.format = format, .width = width, .height = height}, label);
    };
    for (History& history : histories_)
      history = {texture(GL_RGBA32F, "surface history"), texture(GL_RGBA32F, "reflection history"),
                 texture(GL_RG32F, "depth history")};
    motion_ = texture(GL_RGBA32F, "reflection motion");
    constants_ = gl::Buffer(*api_, sizeof(shared::FrameConstants), "previous frame");
    previous_ = view.frame;
    constants_.write(0, &previous_, sizeof(previous_));
  }
  api_->ClearTexImage(motion_.name(), 0, GL_RGBA, GL_FLOAT, nullptr);
}

void TemporalPass::follow(const FrameView& view, const RayBatch& batch, const gl::Buffer& previousPositions) {
  const bool surfaces = static_cast<bool>(batch.hits.surfaces);
  gl::Program& program = follow_[surfaces];
  if (!program) {
    std::vector<gl::Define> defines;
    if (surfaces) defines.push_back({"HIT_SURFACES"});
    program = gl::Program::compute(*api_, "passes/reflection_motion.comp", defines);
  }
  const auto section = view.profiler.section("composite");
  program.use();
  view.bindRays(batch.rays);
  view.scene.bindSurfaces();
  batch.hits.hits.bindStorage(SSBO_HITS);
  previousPositions.bindStorage(SSBO_PREVIOUS_POSITIONS);
  constants_.bindUniform(UBO_PREVIOUS_FRAME);
  motion_.bindImage(IMAGE_REFLECTION_MOTION, GL_WRITE_ONLY);
  api_->BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, batch.rays.count.name());
  api_->DispatchComputeIndirect(0);
  // The motion of reflections is fetched by run(), and cleared by the next frame.
  api_->MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
}

void TemporalPass::run(const FrameView& view, Past past) {
  const GBuffer& gbuffer = view.gbuffer;
  const History& before = histories_[latest_];
  const History& now = histories_[1 - latest_];
  if (!join_) join_ = gl::Program::compute(*api_, "passes/temporal.comp");
  const auto section = view.profiler.section("composite");
  join_.use();
  join_.set("history", past == Past::none ? HISTORY_NONE : past == Past::still ? HISTORY_STILL : HISTORY_MOVING);
  join_.set("previousEye", previous_.eye);
  join_.set("previousForward", previous_.forward);
  view.bindPixelLight();
  gbuffer.motion.bind(UNIT_MOTION);
  motion_.bind(UNIT_REFLECTION_MOTION);
  before.surface.bind(UNIT_SURFACE_HISTORY);
  before.reflected.bind(UNIT_REFLECTED_HISTORY);
  before.depths.bind(UNIT_DEPTH_HISTORY);
  now.surface.bindImage(IMAGE_SURFACE, GL_WRITE_ONLY);
  now.reflected.bindImage(IMAGE_REFLECTED, GL_WRITE_ONLY);
  now.depths.bindImage(IMAGE_DEPTHS, GL_WRITE_ONLY);
  api_->DispatchCompute(static_cast<GLuint>((gbuffer.width + TEMPORAL_GROUP - 1) / TEMPORAL_GROUP),
                        static_cast<GLuint>((gbuffer.height + TEMPORAL_GROUP - 1) / TEMPORAL_GROUP), 1);
  // The history is fetched by the display and by the next frame.
  api_->MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  latest_ = 1 - latest_;
  previous_ = view.frame;
  constants_.write(0, &previous_, sizeof(previous_));
}

void TemporalPass::forget() {
  histories_ = {};
  motion_ = gl::Texture();
  constants_ = gl::Buffer();
}

std::size_t TemporalPass::bytes() const {
  std::size_t sum = motion_.bytes() + constants_.bytes();
  for (const History& history : histories_)
    sum += history.surface.bytes() + history.reflected.bytes() + history.depths.bytes();
  return sum;
}

}  // namespace halfsilver
