// How a material uses a texture, without the texels.
#include "lib/scene.glsl"

const uint SAMPLING_CLAMP = 2u;
const uint SAMPLING_MIRROR = 1u;
const uint SAMPLING_MAGNIFY_NEAREST = 16u;
const uint SAMPLING_MINIFY_NEAREST = 32u;
const uint SAMPLING_NO_MIPMAPS = 64u;
const uint SAMPLING_UV_SET = 128u;

bool hasTexture(GpuTexture use) { return use.location != NO_TEXTURE; }
