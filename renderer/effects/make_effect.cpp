#include <array>
#include <utility>

#include "effects/layers/layers_effect.h"
#include "effects/occlusion/occlusion_effect.h"
#include "effects/path/path_effect.h"
#include "effects/ray_effect.h"
#include "effects/reflection/reflection_effect.h"
#include "effects/whitted/whitted_effect.h"

namespace halfsilver {
namespace {

template <class T>
std::unique_ptr<RayEffect> make(const gl::Api& api) {
  return std::make_unique<T>(api);
}

// In the order of the enumerators.
constexpr std::array kEffects{make<ReflectionEffect>, make<WhittedEffect>, make<OcclusionEffect>, make<PathEffect>,
                              make<LayersEffect>};

}  // namespace

std::unique_ptr<RayEffect> makeEffect(const gl::Api& api, Effect effect) {
  return kEffects[static_cast<std::size_t>(effect)](api);
}

}  // namespace halfsilver
