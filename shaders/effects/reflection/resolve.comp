// From slots to pixels: the mean of what a pixel's rays have gathered. Its slots lie side by side and are added in their
// order, so the sum does not depend on the order in which rays were traced. One invocation per pixel of the queue.
// With LIGHT_RAYS direct light on what they found was summed up by pixel.
#include "effects/common/summed_light.glsl"
#include "lib/frame.glsl"
#include "shared/passes/resolve.h"
#include "shared/rays.h"

layout(local_size_x = 64) in;

layout(std430, binding = SSBO_RAY_COUNT) readonly buffer RayCountBlock { RayCount rayCount; };
layout(std430, binding = SSBO_SLOTS) readonly buffer SlotBlock { Radiance slots[]; };

#ifdef LIGHT_RAYS
layout(std430, binding = SSBO_DIRECT_LIGHT) readonly buffer DirectLightBlock { LightSum directLight[]; };

uniform uint firstPixel;  // of the batch
#endif

layout(binding = IMAGE_REFLECTION, rgba32f) uniform writeonly image2D reflection;

uniform uint slotsPerPixel;

void main() {
  uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
  if (index >= rayCount.count / slotsPerPixel) return;
  vec3 sum = vec3(0.0);
  float answered = 0.0;
  uint pixel = NO_PIXEL;
  for (uint i = 0u; i < slotsPerPixel; ++i) {
    Radiance slot = slots[index * slotsPerPixel + i];
    if (slot.pixel == NO_PIXEL) continue;
    pixel = slot.pixel;
    sum += slot.sum;
    answered += 1.0;
  }
  if (pixel == NO_PIXEL) return;
#ifdef LIGHT_RAYS
  sum += radianceOf(directLight[pixel - firstPixel]);
#endif
  imageStore(reflection, ivec2(pixel % frame.width, pixel / frame.width), vec4(sum / answered, 1.0));
}
