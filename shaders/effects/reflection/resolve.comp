// From slots to pixels: the mean of what a pixel's rays have gathered. Its slots lie side by side and are added in their
// order, so the sum does not depend on the order in which rays were traced. One invocation per pixel of the queue.
#include "lib/frame.glsl"
#include "shared/passes/resolve.h"
#include "shared/rays.h"

layout(local_size_x = 64) in;

layout(std430, binding = SSBO_RAY_COUNT) readonly buffer RayCountBlock { RayCount rayCount; };
layout(std430, binding = SSBO_SLOTS) readonly buffer SlotBlock { Radiance slots[]; };
layout(std430, binding = SSBO_SLOT_PIXELS) readonly buffer SlotPixelBlock { uint slotPixels[]; };

layout(binding = IMAGE_REFLECTION, rgba32f) uniform writeonly image2D reflection;

uniform uint slotsPerPixel;

void main() {
  uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
  if (index >= rayCount.count / slotsPerPixel) return;
  vec3 sum = vec3(0.0);
  uint answered = 0u;
  for (uint i = 0u; i < slotsPerPixel; ++i) {
    Radiance slot = slots[index * slotsPerPixel + i];
    if (slot.answered == 0u) continue;
    sum += slot.sum;
    ++answered;
  }
  if (answered == 0u) return;
  ivec2 pixel = ivec2(slotPixels[index] % frame.width, slotPixels[index] / frame.width);
  imageStore(reflection, pixel, vec4(sum / float(answered), 1.0));
}
