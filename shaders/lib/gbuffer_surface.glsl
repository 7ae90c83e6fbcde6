// The surface of a pixel, from the G-buffer, until deferred shading stores light over it.
#include "lib/coat.glsl"
#include "lib/gbuffer.glsl"
#include "lib/surface.glsl"
#include "lib/triangle_point.glsl"

layout(rgba32f, binding = IMAGE_SHADED) uniform image2D shaded;
layout(rgba32f, binding = IMAGE_REFLECTION) uniform image2D reflection;

// Not of a pixel that shows none.
Surface surfaceOfPixel(ivec2 pixel) {
  vec4 baseColor = imageLoad(shaded, pixel);
  vec4 material = texelFetch(gMaterial, pixel, 0);
  vec4 emissive = imageLoad(reflection, pixel);
  vec4 normal = facingAt(pixel);
  uint triangle = texelFetch(gVisibility, pixel, 0).r - 1u;
  vec3 a, b, c;
  trianglePositions(triangle, a, b, c);
  vec3 geometric = normalize(cross(b - a, c - a));

  Surface s;
  s.position = pointOnTriangle(a, b, c, pixelOrigin(pixel), pixelRay(pixel)).position;
  s.geometricNormal = dot(geometric, fromCamera(s.position)) > 0.0 ? -geometric : geometric;
  s.normal = normal.xyz;
  s.baseColor = baseColor.rgb;
  s.emissive = emissive.rgb;
  s.f0 = material.rgb;
  s.roughness = material.a;
  s.metallic = emissive.a;
  s.occlusion = baseColor.a;
  s.reflectivity = max(normal.w, 0.0);
  s.unlit = material.a < 0.0;
  leaveOutLayers(s);
#ifdef LOBES
  uvec4 lobes = texelFetch(gLobes, pixel, 0);
  vec2 blueAndRoughness = unpackHalf2x16(lobes.y), depthAndStrength = unpackHalf2x16(lobes.w);
  s.sheenColor = vec3(unpackHalf2x16(lobes.x), blueAndRoughness.x);
  s.sheenRoughness = blueAndRoughness.y;
  s.anisotropyDirection = vec3(unpackHalf2x16(lobes.z), depthAndStrength.x);
  s.anisotropy = depthAndStrength.y;
#endif
#ifdef COATS
  vec4 coat = texelFetch(gCoat, pixel, 0);
  if (coat.z != 0.0) {
    bool ofCoat = coat.z < 0.0;
    vec3 other = fromOctahedral(coat.xy);
    s.coat = abs(coat.z);
    s.coatNormal = ofCoat ? s.normal : other;
    s.coatRoughness = ofCoat ? s.roughness : coat.w;
    if (ofCoat) {
      s.normal = other;
      s.roughness = coat.w;
    }
  }
#endif
  return s;
}
