// Counts the first rays by what they contribute to the shaded picture.
#include "effects/reflection/contribution.glsl"
#include "lib/queued_ray.glsl"
#include "shared/passes/spawn.h"
#include "shared/rays.h"

layout(local_size_x = 64) in;

layout(std430, binding = SSBO_RAY_COUNT) readonly buffer RayCountBlock { RayCount rayCount; };
layout(std430, binding = SSBO_CONTRIBUTIONS) buffer ContributionBlock { uint contributions[CONTRIBUTION_CLASSES]; };

// A mirror has few classes: without these, all its pixels would meet at a few words.
shared uint counts[CONTRIBUTION_CLASSES];

void main() {
  uint lane = gl_LocalInvocationID.x;
  for (uint i = lane; i < uint(CONTRIBUTION_CLASSES); i += gl_WorkGroupSize.x) counts[i] = 0u;
  barrier();
  uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + lane;
  if (index < rayCount.count) {
    uint number = pixelOfRay(index);
    ivec2 pixel = ivec2(number % frame.width, number / frame.width);
    vec4 normal = facingAt(pixel);
    if (!goesOn(normal)) atomicAdd(counts[contributionClass(contributionOf(pixel, normal))], 1u);
  }
  barrier();
  for (uint i = lane; i < uint(CONTRIBUTION_CLASSES); i += gl_WorkGroupSize.x)
    if (counts[i] != 0u) atomicAdd(contributions[i], counts[i]);
}
