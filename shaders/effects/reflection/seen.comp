// What the screen has answered to the rays of look.comp, pixel by pixel: the light of the pixels that show what they
// hit, with what was traced there, and the share of those that hit nothing; -1 there if nobody has looked. Rays are added
// in their order. Of directions in which the screen shows nothing no more see the sky than do of all; bounced light stands
// in for what hides it from the others.
#include "lib/blend.glsl"
#include "lib/bounced_light.glsl"
#include "lib/queued_ray.glsl"
#include "shared/passes/look.h"
#include "shared/rays.h"

layout(local_size_x = 64) in;

layout(std430, binding = SSBO_PATHS) readonly buffer PathBlock { RayPath paths[]; };
layout(std430, binding = SSBO_RAY_COUNT) readonly buffer RayCountBlock { RayCount rayCount; };
layout(std430, binding = SSBO_HITS) readonly buffer HitBlock { Hit hits[]; };

layout(binding = UNIT_REFLECTION) uniform sampler2D gReflection;
layout(binding = UNIT_OCCLUSION) uniform sampler2D gOcclusion;
layout(binding = IMAGE_SEEN, rgba32f) uniform writeonly image2D seen;

// Radiance of what hides the sky from a pixel's surface, as ambientLighting() has it.
vec3 hidingTheSky(ivec2 pixel, vec3 normal, float visibility) {
  return bouncedIrradiance(normal, visibility) * (texelFetch(gOcclusion, pixel, 0).r / 3.14159265358979);
}

// GBuffer::seen is being made: the sky and bounced light stand in for what the hit itself would ask the screen.
vec3 shownAt(vec3 position) {
  vec4 clip = frame.viewProjection * vec4(position, 1.0);
  ivec2 size = ivec2(frame.width, frame.height);
  ivec2 pixel = clamp(ivec2(floor((0.5 * clip.xy / clip.w + 0.5) * vec2(size))), ivec2(0), size - 1);
  vec4 normal = facingAt(pixel);
  Blend blend = blendOf(pixel, normal);
  vec4 traced = texelFetch(gReflection, pixel, 0), material = texelFetch(gMaterial, pixel, 0);
  vec3 light = blend.base + blend.share * (traced.a > 0.0 ? traced.rgb : blend.sky);
  if (!isSurface(normal) || material.a < 0.0 || goesOn(normal)) return light;
  Mirror mirror = mirrorOf(pixel, material, normal.xyz, -normalize(pixelRay(pixel)));
  float visibility = texelFetch(gShaded, pixel, 0).a;
  return light + mirror.skyShare * (1.0 - visibility) * hidingTheSky(pixel, normal.xyz, visibility);
}

void main() {
  uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
  if (index >= rayCount.count / frame.glossySamples) return;
  uint first = index * frame.glossySamples;
  vec4 sum = vec4(0.0);
  for (uint i = first; i < first + frame.glossySamples; ++i) {
    Hit hit = hits[i];
    vec3 weight = paths[i].throughput;
    if (hit.triangle == NO_TRIANGLE) {
      sum.a += (weight.r + weight.g + weight.b) / 3.0;
      continue;
    }
    Ray ray = queuedRay(i, RAYS_STORED);
    sum.rgb += weight * shownAt(ray.origin + hit.t * ray.direction);
  }
  sum /= float(frame.glossySamples);
  uint number = paths[first].pixel;
  ivec2 pixel = ivec2(number % frame.width, number / frame.width);
  float visibility = texelFetch(gShaded, pixel, 0).a;
  sum.rgb += max(sum.a - visibility, 0.0) * hidingTheSky(pixel, facingAt(pixel).xyz, visibility);
  imageStore(seen, pixel, sum);
}
