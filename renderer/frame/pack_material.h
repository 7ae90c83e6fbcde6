#pragma once

#include <array>
#include <cstdint>
#include <span>

#include <halfsilver/scene.h>
#include <halfsilver/shared_structs.h>
#include "frame/alpha_texels.h"

// A material as shaders read it.
namespace halfsilver {

// In the order of TEXTURE_BASE_COLOR and so on, none of them null.
using TextureUses = std::array<const TextureUse*, TEXTURE_USES>;
TextureUses textureUses(const Material& material);

// holes: whether the alpha test can fail. locations: by texture of the scene, see MaterialTextures.
shared::GpuMaterial packMaterial(const Material& material, bool holes, const AlphaPlace& alpha,
                                 std::span<const std::uint32_t> locations);

}  // namespace halfsilver
