// What the screen has answered to the rays of look.comp, pixel by pixel: the light of the pixels that show what they
// hit, with what was traced there, and the share of those that hit nothing; -1 there if nobody has looked. Rays are added
// in their order.
#include "lib/queued_ray.glsl"
#include "lib/blend.glsl"
#include "shared/passes/look.h"
#include "shared/rays.h"

layout(local_size_x = 64) in;

layout(std430, binding = SSBO_PATHS) readonly buffer PathBlock { RayPath paths[]; };
layout(std430, binding = SSBO_RAY_COUNT) readonly buffer RayCountBlock { RayCount rayCount; };
layout(std430, binding = SSBO_HITS) readonly buffer HitBlock { Hit hits[]; };

layout(binding = UNIT_REFLECTION) uniform sampler2D gReflection;
layout(binding = IMAGE_SEEN, rgba32f) uniform writeonly image2D seen;

// GBuffer::seen is being made: the sky stands in for what the hit itself would ask the screen.
vec3 shownAt(vec3 position) {
  vec4 clip = frame.viewProjection * vec4(position, 1.0);
  ivec2 size = ivec2(frame.width, frame.height);
  ivec2 pixel = clamp(ivec2(floor((0.5 * clip.xy / clip.w + 0.5) * vec2(size))), ivec2(0), size - 1);
  Blend blend = blendOf(pixel, texelFetch(gPosition, pixel, 0), texelFetch(gNormal, pixel, 0));
  vec4 traced = texelFetch(gReflection, pixel, 0);
  return blend.base + blend.share * (traced.a > 0.0 ? traced.rgb : blend.sky);
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
  uint pixel = paths[first].pixel;
  imageStore(seen, ivec2(pixel % frame.width, pixel / frame.width), sum / float(frame.glossySamples));
}
