// The G-buffer as later passes read it (see GBuffer in frame/products.h).
#include "lib/frame.glsl"
#include "lib/packed_normal.glsl"
#include "shared/passes/gbuffer.h"
#include "shared/rays.h"

layout(binding = UNIT_DEPTH) uniform sampler2D gDepth;  // see drawnDepth()
layout(binding = UNIT_NORMAL) uniform usampler2D gNormal;  // see facingAt()
layout(binding = UNIT_MATERIAL) uniform sampler2D gMaterial;
#ifdef LOBES
layout(binding = UNIT_LOBES) uniform usampler2D gLobes;
#endif
layout(binding = UNIT_VISIBILITY) uniform usampler2D gVisibility;
layout(binding = UNIT_COAT) uniform sampler2D gCoat;  // see lib/coat.glsl

// The shading normal; w reflectivity (faded by roughness), or -alpha where the pixel's ray goes on behind its surface.
vec4 facingAt(ivec2 pixel) { return unpackNormal(texelFetch(gNormal, pixel, 0).xy); }

// Of that: whether there is a surface, whether the pixel's ray goes on behind its surface, and the surface's alpha.
bool isSurface(vec4 normal) { return normal.xyz != vec3(0.0); }
bool goesOn(vec4 normal) { return normal.w < 0.0; }
float alphaOf(vec4 normal) { return normal.w < 0.0 ? -normal.w : 1.0; }

// Meters along the view axis, from what passes/visibility.vert makes of them.
float metersOf(float depth) {
  float near = frame.drawnNear, far = frame.farPlane;
  if (depth <= 0.0) return FAR_AWAY;
  if (frame.parallel != 0u) return far - depth * (far - near);
  return far > 0.0 ? near * far / (depth * (far - near) + near) : near / depth;
}

// What surfacePoint() says, as rasterization has it: nearly, and without a look at the triangle. As far as can be if
// there is none.
float drawnDepth(ivec2 pixel) { return metersOf(texelFetch(gDepth, pixel, 0).r); }
vec3 drawnPoint(ivec2 pixel) { return pixelOrigin(pixel) + drawnDepth(pixel) * pixelRay(pixel); }

// Whether the pixel shows the mean of those around it, see PrimarySettings.
bool isInterpolated(ivec2 pixel) { return texelFetch(gMaterial, pixel, 0).a == INTERPOLATED; }
