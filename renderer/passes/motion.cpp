#include "passes/motion.h"

#include <utility>

#include "scene/vertex_ranges.h"
#include "shared/passes/motion.h"

namespace halfsilver {
namespace {

constexpr int kTile = 8;
constexpr GLsizeiptr kVertexBytes = 3 * sizeof(float);

}  // namespace

void MotionPass::run(const FrameView& view, std::vector<VertexRange> moved, bool next, GBuffer& gbuffer) {
  const gl::Api& gl = *api_;
  if (next) {
    advance(view.scene);
    frame_ = view.frame;
    moved_ = std::move(moved);
  }
  if (!program_) program_ = gl::Program::compute(gl, "passes/motion.comp");
  if (!gbuffer.motion)
    gbuffer.motion = gl::Texture(gl, {.format = GL_RG32F, .width = gbuffer.width, .height = gbuffer.height}, "motion");
  const auto section = view.profiler.section("gbuffer");
  if (!positions_) {
    positions_ = gl::Buffer(gl, view.scene.positions.bytes(), "previous positions");
    gl.CopyNamedBufferSubData(view.scene.positions.name(), positions_.name(), 0, 0,
                              static_cast<GLsizeiptr>(positions_.bytes()));
    constants_ = gl::Buffer(gl, sizeof(shared::FrameConstants), "previous frame");
    constants_.write(0, &view.frame, sizeof(view.frame));
  }
  program_.use();
  view.constants.bindUniform(UBO_FRAME);
  view.scene.bindTriangles();
  bindPrevious();
  gbuffer.visibility.bind(UNIT_VISIBILITY);
  gbuffer.motion.bindImage(IMAGE_MOTION, GL_WRITE_ONLY);
  gl.DispatchCompute(static_cast<GLuint>((gbuffer.width + kTile - 1) / kTile),
                     static_cast<GLuint>((gbuffer.height + kTile - 1) / kTile), 1);
  // The dispatch writes the motion; antialiasing fetches it, the layers read it back.
  gl.MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
}

void MotionPass::advance(const GpuScene& scene) {
  if (!frame_) return;
  constants_.write(0, &*frame_, sizeof(*frame_));
  for (const VertexRange& range : mergeRanges(moved_))
    api_->CopyNamedBufferSubData(scene.positions.name(), positions_.name(), range.first * kVertexBytes,
                                 range.first * kVertexBytes, range.count * kVertexBytes);
  frame_.reset();
  moved_.clear();
}

void MotionPass::forget() {
  positions_ = gl::Buffer();
  constants_ = gl::Buffer();
  frame_.reset();
  moved_.clear();
}

void MotionPass::bindPrevious() const {
  constants_.bindUniform(UBO_PREVIOUS_FRAME);
  positions_.bindStorage(SSBO_PREVIOUS_POSITIONS);
}

}  // namespace halfsilver
