// The surface of a pixel, from the G-buffer.
#include "lib/gbuffer.glsl"
#include "lib/surface.glsl"
#include "lib/triangles.glsl"

Surface surfaceOfPixel(ivec2 pixel, vec3 position) {
  vec4 baseColor = texelFetch(gBaseColor, pixel, 0);
  vec4 material = texelFetch(gMaterial, pixel, 0);
  vec4 emissive = texelFetch(gEmissive, pixel, 0);
  vec4 normal = texelFetch(gNormal, pixel, 0);
  uint triangle = texelFetch(gVisibility, pixel, 0).r - 1u;
  vec3 a, b, c;
  trianglePositions(triangle, a, b, c);
  vec3 geometric = normalize(cross(b - a, c - a));

  Surface s;
  s.position = position;
  s.geometricNormal = dot(geometric, fromCamera(position)) > 0.0 ? -geometric : geometric;
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
  vec4 sheen = texelFetch(gSheen, pixel, 0), anisotropy = texelFetch(gAnisotropy, pixel, 0);
  s.sheenColor = sheen.rgb;
  s.sheenRoughness = sheen.a;
  s.anisotropyDirection = anisotropy.xyz;
  s.anisotropy = anisotropy.w;
#endif
  return s;
}
