// From triangle numbers to surfaces, one per pixel. With PRIMARY_RULES see primary_hit.glsl.
#include "lib/triangle_point.glsl"
#include "lib/evaluate_surface.glsl"
#include "shared/passes/gbuffer.h"
#ifdef PRIMARY_RULES
#include "passes/primary_hit.glsl"
#endif

layout(local_size_x = 8, local_size_y = 8) in;

#ifndef PRIMARY_RULES
layout(binding = UNIT_VISIBILITY) uniform usampler2D visibility;
#endif
layout(rgba32f, binding = IMAGE_POSITION) uniform writeonly image2D positionImage;
layout(rgba32f, binding = IMAGE_NORMAL) uniform writeonly image2D normalImage;
layout(rgba16f, binding = IMAGE_BASE_COLOR) uniform writeonly image2D baseColorImage;
layout(rgba16f, binding = IMAGE_MATERIAL) uniform writeonly image2D materialImage;
layout(binding = IMAGE_EMISSIVE) uniform writeonly image2D emissiveImage;
#ifdef LOBES
layout(rgba16f, binding = IMAGE_SHEEN) uniform writeonly image2D sheenImage;
layout(rgba16f, binding = IMAGE_ANISOTROPY) uniform writeonly image2D anisotropyImage;
#endif

// Proves to the host that the device has run this frame.
layout(std430, binding = SSBO_SIGNATURE) writeonly buffer SignatureBlock { uint signature; };
uniform uint number;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (pixel == ivec2(0)) signature = number;
  if (any(greaterThanEqual(pixel, ivec2(frame.width, frame.height)))) return;
  vec4 position = vec4(0.0), normal = vec4(0.0), baseColor = vec4(0.0), material = vec4(0.0), emissive = vec4(0.0);
#ifdef PRIMARY_RULES
  PrimaryHit hit = primaryHit(pixel);
  uint visible = hit.visible;
  if (!hit.known) position.w = -1.0;  // its color is interpolated
#else
  uint visible = texelFetch(visibility, pixel, 0).x;
#endif
  if (visible != 0u) {
    TrianglePoint point = pointOnTriangle(visible - 1u, pixelOrigin(pixel), pixelRay(pixel));
    float range = length(point.relative);
    Surface s = evaluateSurface(visible - 1u, point.barycentrics, normalize(point.relative), coneWidth(range),
                                BASE_TEXTURES);
    position = vec4(point.position, dot(point.relative, frame.forward));
    bool goesOn = frame.blends != 0u && frame.allLight == 0u && s.alpha < 1.0;
    normal = vec4(s.normal, goesOn ? -s.alpha : s.reflectivity);
    baseColor = vec4(s.baseColor, s.occlusion);
    material = vec4(s.f0, s.unlit ? -1.0 : s.roughness);
    emissive = vec4(s.emissive, s.metallic);
#ifdef LOBES
    imageStore(sheenImage, pixel, vec4(s.sheenColor, s.sheenRoughness));
    imageStore(anisotropyImage, pixel, vec4(s.anisotropyDirection, s.anisotropy));
#endif
  }
  imageStore(positionImage, pixel, position);
  imageStore(normalImage, pixel, normal);
  imageStore(baseColorImage, pixel, baseColor);
  imageStore(materialImage, pixel, material);
  imageStore(emissiveImage, pixel, emissive);
}
