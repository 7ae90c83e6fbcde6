// Deferred shading: direct light and sky light of every pixel, without reflections.
#include "lib/gbuffer.glsl"
#include "lib/lights.glsl"
#include "lib/sky.glsl"
#include "lib/triangles.glsl"
#include "shared/passes/shade.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = IMAGE_SHADED) writeonly uniform image2D shaded;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (pixel.x >= int(frame.width) || pixel.y >= int(frame.height)) return;
  vec4 position = texelFetch(gPosition, pixel, 0);
  if (position.w <= 0.0) {
    imageStore(shaded, pixel, vec4(skyRadiance(normalize(pixelRay(pixel)), 0.0), 1.0));
    return;
  }
  vec4 baseColor = texelFetch(gBaseColor, pixel, 0);
  vec4 material = texelFetch(gMaterial, pixel, 0);
  vec4 emissive = texelFetch(gEmissive, pixel, 0);
  vec4 normal = texelFetch(gNormal, pixel, 0);
  uint triangle = texelFetch(gVisibility, pixel, 0).r - 1u;
  vec3 toEye = normalize(frame.eye - position.xyz);

  vec3 a, b, c;
  trianglePositions(triangle, a, b, c);
  vec3 geometric = normalize(cross(b - a, c - a));

  Surface s;
  s.position = position.xyz;
  s.geometricNormal = dot(geometric, toEye) < 0.0 ? -geometric : geometric;
  s.normal = normal.xyz;
  s.baseColor = baseColor.rgb;
  s.emissive = emissive.rgb;
  s.f0 = material.rgb;
  s.roughness = material.a;
  s.metallic = emissive.a;
  s.occlusion = baseColor.a;
  s.reflectivity = normal.w;
  s.unlit = material.a < 0.0;
  leaveOutLayers(s);
  imageStore(shaded, pixel, directLighting(s, toEye));
}
