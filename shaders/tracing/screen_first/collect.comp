// Rays that the screen has not answered become a queue of their own. One invocation per ray.
#include "lib/queued_ray.glsl"
#include "shared/bindings.h"
#include "shared/passes/screen.h"
#include "shared/passes/trace.h"
#include "shared/rays.h"

layout(local_size_x = TRACE_GROUP) in;
layout(std430, binding = SSBO_RAY_COUNT) readonly buffer RayCountBlock { RayCount rayCount; };
layout(std430, binding = SSBO_HITS) readonly buffer HitBlock { Hit hits[]; };
layout(std430, binding = SSBO_REST_RAYS) writeonly buffer RestRayBlock { uint restRays[]; };
layout(std430, binding = SSBO_REST_COUNT) buffer RestCountBlock { RayCount restCount; };
layout(std430, binding = SSBO_REST_INDICES) writeonly buffer RestIndexBlock { uint restIndices[]; };
layout(std430, binding = SSBO_ANSWERS) writeonly buffer AnswerBlock { uint answers[]; };

uniform int keepAnswers;

void main() {
  uint index =
      (gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
  if (index >= rayCount.count) return;
  bool answered = hits[index].t != HIT_NOT_TRACED;
  if (keepAnswers == 1) answers[index] = answered ? ANSWER_FIRST : ANSWER_STRUCTURE;
  if (answered) return;
  uint place = atomicAdd(restCount.count, 1u);
  restIndices[place] = index;
  if (rayCount.source != RAYS_STORED) {
    restRays[place] = pixelOfRay(index);
  } else {
    for (uint row = 0u; row < 2u; ++row)
      for (uint i = 0u; i < 4u; ++i) restRays[8u * place + 4u * row + i] = rayRows[2u * index + row][i];
  }
}
