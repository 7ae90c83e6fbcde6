// Adds what the rays of spawn_behind.comp have gathered to the shaded pixels, one invocation per ray; where one was given
// up, the sky. With LIGHT_RAYS direct light on what they found was summed up by pixel.
#include "effects/common/summed_light.glsl"
#include "lib/queued_ray.glsl"
#include "lib/sky.glsl"
#include "shared/passes/resolve.h"

layout(local_size_x = 64) in;

layout(std430, binding = SSBO_PATHS) readonly buffer PathBlock { RayPath paths[]; };
layout(std430, binding = SSBO_RAY_COUNT) readonly buffer RayCountBlock { RayCount rayCount; };
layout(std430, binding = SSBO_SLOTS) readonly buffer SlotBlock { Radiance slots[]; };

#ifdef LIGHT_RAYS
layout(std430, binding = SSBO_DIRECT_LIGHT) readonly buffer DirectLightBlock { LightSum directLight[]; };

uniform uint firstPixel;  // of the batch
#endif

layout(binding = IMAGE_SHADED, rgba32f) uniform image2D shaded;

void main() {
  uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
  if (index >= rayCount.count) return;
  RayPath path = paths[index];
  Radiance slot = slots[path.slot];
  vec3 light = slot.sum;
  if (slot.pixel == NO_PIXEL) light = path.throughput * skyRadiance(queuedRay(index, RAYS_STORED).direction, 0.0);
#ifdef LIGHT_RAYS
  light += radianceOf(directLight[path.pixel - firstPixel]);
#endif
  ivec2 pixel = ivec2(path.pixel % frame.width, path.pixel / frame.width);
  imageStore(shaded, pixel, imageLoad(shaded, pixel) + vec4(light, 0.0));
}
