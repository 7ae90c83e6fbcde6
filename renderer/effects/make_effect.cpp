#include "effects/ray_effect.h"
#include "effects/reflection/reflection_effect.h"

namespace halfsilver {

std::unique_ptr<RayEffect> makeEffect(const gl::Api& api, const Settings&) {
  return std::make_unique<ReflectionEffect>(api);
}

}  // namespace halfsilver
