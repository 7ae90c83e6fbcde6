#include "passes/temporal.h"

#include <algorithm>
#include <string>
#include <vector>

#include "shared/passes/motion.h"

namespace halfsilver {

void TemporalPass::begin(const FrameView& view) {
  const int width = view.gbuffer.width, height = view.gbuffer.height;
  if (!motion_ || motion_.shape().width != width || motion_.shape().height != height) {
    forget();  // the old memory goes before the new comes
    const auto texture = [&](GLenum format, const char* label) {
      return gl::Texture(*api_, {.format = format, .width = width, .height = height}, label);
    };
    frames_ = gl::Texture(*api_,
                          {.target = GL_TEXTURE_2D_ARRAY,
                           .format = GL_RG32UI,
                           .width = width,
                           .height = height,
                           .depth = 2 * TEMPORAL_FRAMES},
                          "past frames");
    mean_ = texture(GL_RGBA32F, "joined frames");
    for (Known& known : known_) known = {texture(GL_RG8, "counts of frames"), texture(GL_RG32F, "depth history")};
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
  const Known& before = known_[latest_];
  const Known& now = known_[1 - latest_];
  number_ = (number_ + 1) % TEMPORAL_FRAMES;
  std::rotate(jitters_.begin(), jitters_.end() - 1, jitters_.end());
  jitters_[0] = view.frame.jitter;
  if (!join_) join_ = gl::Program::compute(*api_, "passes/temporal.comp");
  const auto section = view.profiler.section("composite");
  join_.use();
  join_.set("history", past == Past::none ? HISTORY_NONE : past == Past::still ? HISTORY_STILL : HISTORY_MOVING);
  join_.set("number", number_);
  for (std::size_t age = 0; age < jitters_.size(); ++age)
    join_.set("jitters[" + std::to_string(age) + "]", jitters_[age]);
  join_.set("previousEye", previous_.eye);
  join_.set("previousForward", previous_.forward);
  view.bindPixelLight();
  gbuffer.motion.bind(UNIT_MOTION);
  motion_.bind(UNIT_REFLECTION_MOTION);
  frames_.bind(UNIT_PAST_FRAMES);
  before.counts.bind(UNIT_COUNTS_BEFORE);
  before.depths.bind(UNIT_DEPTHS_BEFORE);
  mean_.bindImage(IMAGE_MEAN, GL_READ_WRITE);
  frames_.bindImage(IMAGE_FRAME, GL_WRITE_ONLY);  // other layers than those that are fetched
  now.counts.bindImage(IMAGE_COUNTS, GL_WRITE_ONLY);
  now.depths.bindImage(IMAGE_DEPTHS, GL_WRITE_ONLY);
  api_->DispatchCompute(static_cast<GLuint>((gbuffer.width + TEMPORAL_GROUP - 1) / TEMPORAL_GROUP),
                        static_cast<GLuint>((gbuffer.height + TEMPORAL_GROUP - 1) / TEMPORAL_GROUP), 1);
  // The mean is fetched by the display and read by the next frame, which fetches the others.
  api_->MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  latest_ = 1 - latest_;
  previous_ = view.frame;
  constants_.write(0, &previous_, sizeof(previous_));
}

void TemporalPass::forget() {
  frames_ = gl::Texture();
  mean_ = gl::Texture();
  known_ = {};
  motion_ = gl::Texture();
  constants_ = gl::Buffer();
}

std::size_t TemporalPass::bytes() const {
  std::size_t sum = frames_.bytes() + mean_.bytes() + motion_.bytes() + constants_.bytes();
  for (const Known& known : known_) sum += known.counts.bytes() + known.depths.bytes();
  return sum;
}

}  // namespace halfsilver
