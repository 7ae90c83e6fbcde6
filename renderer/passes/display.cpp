#include "passes/display.h"

#include <utility>
#include <vector>

#include "shared/passes/display.h"

namespace halfsilver {

void DisplayPass::run(const FrameView& view, const Source& source, Output output, const Target& target) {
  const bool depth = target.depth != DepthUse::none;
  gl::Program& program = programs_[output == Output::linear][depth];
  if (!program) {
    std::vector<gl::Define> defines;
    if (output == Output::linear) defines.push_back({"LINEAR"});
    program = draw_.program("passes/display.frag", std::move(defines), depth);
  }
  const auto section = view.profiler.section("composite");
  program.set("scale", source.scale);
  source.picture.bind(UNIT_PICTURE);
  draw_.run(view, program, target);
}

}  // namespace halfsilver
