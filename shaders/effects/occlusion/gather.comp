// A ray that nothing stops brings light of 1; one that was given up, none. Where surfaces blend: blend.comp.
#include "effects/common/light_sums.glsl"
#include "shared/bindings.h"
#include "shared/structs.h"

layout(local_size_x = 64) in;

layout(std430, binding = SSBO_PATHS) readonly buffer PathBlock { ScatteredPath paths[]; };
layout(std430, binding = SSBO_RAY_COUNT) readonly buffer RayCountBlock { RayCount rayCount; };
layout(std430, binding = SSBO_HITS) readonly buffer HitBlock { Hit hits[]; };

void main() {
  uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
  if (index >= rayCount.count || hits[index].t != HIT_MISS) return;
  addLight(paths[index].pixel, paths[index].throughput);
}
