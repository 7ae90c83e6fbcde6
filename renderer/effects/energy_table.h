#pragma once

#include <halfsilver/frame_view.h>
#include "gl/program.h"

namespace halfsilver {

// What rough surfaces reflect of the light that they scatter once, for shaders/lib/bsdf.glsl. Made on first use.
class EnergyTable {
 public:
  explicit EnergyTable(const gl::Api& api) : api_(&api) {}

  // UNIT_ENERGY.
  void bind();
  std::uint64_t bytes() const { return table_.bytes(); }

 private:
  const gl::Api* api_;
  gl::Texture table_;
};

}  // namespace halfsilver
