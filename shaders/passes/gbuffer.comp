// From triangle numbers to surfaces, one per pixel. With PRIMARY_RULES see primary_hit.glsl, with COATS lib/coat.glsl,
// with TRANSMISSION lib/clear.glsl.
#include "lib/triangle_point.glsl"
#include "lib/evaluate_surface.glsl"
#include "shared/passes/gbuffer.h"
#include "lib/clear.glsl"
#include "lib/coat.glsl"
#include "lib/packed_normal.glsl"
#ifdef PRIMARY_RULES
#include "passes/primary_hit.glsl"
#endif

layout(local_size_x = 8, local_size_y = 8) in;

#ifndef PRIMARY_RULES
layout(binding = UNIT_VISIBILITY) uniform usampler2D visibility;
#endif
layout(rgba32f, binding = IMAGE_SHADED) uniform writeonly image2D shaded;
layout(rgba32f, binding = IMAGE_REFLECTION) uniform writeonly image2D reflection;
layout(rg32ui, binding = IMAGE_NORMAL) uniform writeonly uimage2D normalImage;
layout(rgba16f, binding = IMAGE_MATERIAL) uniform writeonly image2D materialImage;
#ifdef LOBES
layout(rgba32ui, binding = IMAGE_LOBES) uniform writeonly uimage2D lobesImage;
#endif
#ifdef COATS
layout(rgba32f, binding = IMAGE_COAT) uniform writeonly image2D coatImage;
#endif
#if defined COATS || defined TRANSMISSION
const uint READ_TEXTURES = ALL_TEXTURES;
#else
const uint READ_TEXTURES = BASE_TEXTURES;
#endif

// Proves to the host that the device has run this frame.
layout(std430, binding = SSBO_SIGNATURE) writeonly buffer SignatureBlock { uint signature; };
uniform uint number;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (pixel == ivec2(0)) signature = number;
  if (any(greaterThanEqual(pixel, ivec2(frame.width, frame.height)))) return;
  vec4 normal = vec4(0.0), baseColor = vec4(0.0), material = vec4(0.0), emissive = vec4(0.0);
#ifdef COATS
  vec4 coat = vec4(0.0);
#endif
#ifdef PRIMARY_RULES
  PrimaryHit hit = primaryHit(pixel);
  uint visible = hit.visible;
  if (!hit.known) material.a = INTERPOLATED;
#else
  uint visible = texelFetch(visibility, pixel, 0).x;
#endif
  if (visible != 0u) {
    TrianglePoint point = pointOnTriangle(visible - 1u, pixelOrigin(pixel), pixelRay(pixel));
    float range = length(point.relative);
    vec3 direction = normalize(point.relative);
    Surface s = evaluateSurface(visible - 1u, point.barycentrics, direction, coneWidth(range), READ_TEXTURES);
#ifdef TRANSMISSION
    bool entering = s.thin || meetsFront(visible - 1u, direction);
    takeClear(s, direction, entering ? 1.0 / s.ior : s.ior, false);
    if (!entering && s.transmission > 0.0) s.coat = 0.0;  // of its outside
#endif
    bool goesOn = frame.blends != 0u && frame.allLight == 0u && s.alpha < 1.0;
    normal = vec4(s.normal, goesOn ? -s.alpha : s.reflectivity);
    baseColor = vec4(s.baseColor, s.occlusion);
    material = vec4(s.f0, s.unlit ? -1.0 : s.roughness);
    emissive = vec4(s.emissive, s.metallic);
#ifdef LOBES
    imageStore(lobesImage, pixel,
               uvec4(packHalf2x16(s.sheenColor.rg), packHalf2x16(vec2(s.sheenColor.b, s.sheenRoughness)),
                     packHalf2x16(s.anisotropyDirection.xy), packHalf2x16(vec2(s.anisotropyDirection.z, s.anisotropy))));
#endif
#ifdef COATS
    if (s.coat > 0.0 && !s.unlit) {
      bool ofCoat = followsCoat(s, -normalize(fromCamera(point.position)));
      coat = vec4(octahedral(ofCoat ? s.normal : s.coatNormal), ofCoat ? -s.coat : s.coat,
                  ofCoat ? s.roughness : s.coatRoughness);
      normal = vec4(ofCoat ? s.coatNormal : s.normal, goesOn ? normal.w : followedReflectivity(s, ofCoat));
      if (ofCoat) material.a = s.coatRoughness;
    }
#endif
  }
#ifdef COATS
  imageStore(coatImage, pixel, coat);
#endif
  imageStore(normalImage, pixel, uvec4(visible != 0u ? packNormal(normal) : uvec2(0u), 0u, 0u));
  imageStore(materialImage, pixel, material);
  imageStore(shaded, pixel, baseColor);
  imageStore(reflection, pixel, emissive);
}
