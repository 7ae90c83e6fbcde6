#include "passes/composite.h"

#include <utility>
#include <vector>

namespace halfsilver {
namespace {

gl::Program makeProgram(const TargetDraw& draw, CompositePass::Output output, bool depth) {
  using Output = CompositePass::Output;
  std::vector<gl::Define> defines;
  if (output != Output::display) defines.push_back({output == Output::linear ? "LINEAR" : "UNDITHERED"});
  return draw.program("passes/composite.frag", std::move(defines), depth);
}

}  // namespace

CompositePass::CompositePass(const gl::Api& api) : draw_(api) {
  for (const Output output : {Output::display, Output::linear})
    programs_[static_cast<std::size_t>(output)][0] = makeProgram(draw_, output, false);
}

void CompositePass::run(const FrameView& view, Output output, const Target& target) {
  const bool depth = target.depth != DepthUse::none;
  gl::Program& program = programs_[static_cast<std::size_t>(output)][depth];
  if (!program) program = makeProgram(draw_, output, depth);
  const auto section = view.profiler.section("composite");
  view.bindPixelLight();
  draw_.run(view, program, target);
}

}  // namespace halfsilver
