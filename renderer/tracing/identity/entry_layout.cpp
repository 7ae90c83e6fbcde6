#include "tracing/identity/entry_layout.h"

#include <glm/glm.hpp>

namespace halfsilver {

EntryLayout EntryLayout::of(std::uint32_t triangleCount) {
  for (int slices = 4; slices > 1; --slices) {
    if (triangleCount <= 1U << (32 - 3 * slices)) return {slices};
  }
  return {0};
}

void EntryLayout::apply(const gl::Program& program) const {
  const bool boxes = slices > 0;
  const int shift = boxes ? 32 - 3 * slices : 0;
  program.set("boxSlices", slices);
  program.set("triangleBits", boxes ? (1U << shift) - 1 : ~0U);
  program.set("boxShift", static_cast<GLuint>(shift));
  // Two shifts bring up to four bits together.
  program.set("boxFold0", slices > 1 ? 1U : 0U);
  program.set("boxFold1", slices > 2 ? static_cast<GLuint>(slices - 2) : 0U);
  program.set("boxAxes", boxes ? 1U | 1U << slices | 1U << (2 * slices) : 0U);
}

}  // namespace halfsilver
