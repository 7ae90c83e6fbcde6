// The G-buffer as later passes read it (see GBuffer in frame/products.h).
#include "lib/frame.glsl"

layout(binding = UNIT_POSITION) uniform sampler2D gPosition;
layout(binding = UNIT_NORMAL) uniform sampler2D gNormal;
layout(binding = UNIT_MATERIAL) uniform sampler2D gMaterial;
#ifdef LOBES
layout(binding = UNIT_LOBES) uniform usampler2D gLobes;
#endif
layout(binding = UNIT_VISIBILITY) uniform usampler2D gVisibility;
layout(binding = UNIT_COAT) uniform sampler2D gCoat;  // see lib/coat.glsl

// Of gNormal: whether the pixel's ray goes on behind its surface, and the surface's alpha.
bool goesOn(vec4 normal) { return normal.w < 0.0; }
float alphaOf(vec4 normal) { return normal.w < 0.0 ? -normal.w : 1.0; }
