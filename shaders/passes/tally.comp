// Counts the rays of a queue that are of one kind, pixel by pixel, with what became of them.
#include "lib/queued_ray.glsl"
#include "shared/passes/tally.h"

layout(local_size_x = 64) in;

layout(std430, binding = SSBO_PATHS) readonly buffer PathBlock { RayPath paths[]; };
layout(std430, binding = SSBO_RAY_COUNT) readonly buffer RayCountBlock { RayCount rayCount; };
layout(std430, binding = SSBO_HITS) readonly buffer HitBlock { Hit hits[]; };
layout(std430, binding = SSBO_TALLY) buffer TallyBlock { KindTally tally[]; };

uniform uint kind;
uniform uint anyHit;  // hits are not the nearest

void main() {
  uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
  if (index >= rayCount.count) return;
  uint pixel, ofKind;
  if (rayCount.source == RAYS_STORED) {
    pixel = paths[index].pixel;
    ofKind = paths[index].kindAndCounts & 255u;  // of a ScatteredPath, too
  } else {
    RayPath path = pixelPath(pixelOfRay(index), 0u);
    pixel = path.pixel;
    ofKind = path.kindAndCounts & 255u;
  }
  if (ofKind != kind) return;
  atomicAdd(tally[pixel].rays, 1u);
  float t = hits[index].t;
  if (t < 0.0) return;
  atomicAdd(tally[pixel].hits, 1u);
  if (anyHit != 0u) return;
  uint distance = uint(min(t / max(frame.diagonal, 1e-30) / TALLY_UNIT, 4.0e9));
  uint before = atomicAdd(tally[pixel].low, distance);
  if (before > 0xffffffffu - distance) atomicAdd(tally[pixel].high, 1u);
}
