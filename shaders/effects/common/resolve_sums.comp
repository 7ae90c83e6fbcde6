// From sums to pixels: the mean of all passes and samples. One invocation per pixel of the queue.
#include "effects/common/light_sums.glsl"
#include "effects/common/summed_light.glsl"
#include "lib/frame.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = SSBO_RAYS) readonly buffer RayBlock { uint queuedPixels[]; };
layout(std430, binding = SSBO_RAY_COUNT) readonly buffer RayCountBlock { RayCount rayCount; };

layout(binding = IMAGE_REFLECTION, rgba32f) uniform writeonly image2D reflection;

uniform float share;  // of one sample

void main() {
  uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
  if (index >= rayCount.count) return;
  uint pixel = queuedPixels[index];
  vec3 mean = share * radianceOf(lightSums[pixel - firstPixel]);
  imageStore(reflection, ivec2(pixel % frame.width, pixel / frame.width), vec4(mean, 1.0));
}
