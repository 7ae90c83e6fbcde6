#pragma once

#include <cstdint>
#include <vector>

#include <halfsilver/gl/texel_buffer.h>
#include <halfsilver/scene.h>

namespace halfsilver {

// Where the alpha of a material's base color texture lies; all 0 if the material cuts no holes with a texture.
struct AlphaPlace {
  std::uint32_t first = 0, width = 0, height = 0;  // the first alpha's number; texels
};

// Level 0's alpha of all textures that cut holes, as they are in the scene: the alpha test needs no sampler, no switch
// over buckets and a quarter of the bytes. Four share a word of the buffer.
struct AlphaTexels {
  gl::TexelBuffer texels;
  std::vector<AlphaPlace> places;  // one per material
};

// `holes`: translucencyOf(scene).holes. Throws Error (failed) if there are more than the device's buffer textures hold.
AlphaTexels uploadAlphas(const gl::Api& api, const Scene& scene, const std::vector<bool>& holes);

}  // namespace halfsilver
