// Search of the planar method: a ray that leaves the mirror's plane as from an even mirror is one of the mirrored
// picture's; its hit is on what that shows in the pixel that the ray begins in, or in the pixels around it. All other
// rays miss.
#include "lib/gbuffer.glsl"
#include "shared/rays.h"
#include "tracing/common/ray_work.glsl"
#include "tracing/common/test_candidate.glsl"
#include "tracing/common/trace_state.glsl"
#include "tracing/common/walk.glsl"
#include "tracing/planar/mirrored.glsl"

layout(binding = UNIT_CAPTURE) uniform usampler2D mirrored;

// What still is in the plane, of the scene's diagonal, and along the mirror's direction.
const float MAX_OFFSET = 1e-4, MAX_TURN = 1e-3;

bool march(TraceRay ray, float end, inout PausedRay pause, inout Hit best) {
  vec3 way = mirroredDirection(normalize(fromCamera(ray.origin)));
  bool reflected = mirrorPlane.xyz != vec3(0.0) && abs(beforeMirror(ray.origin)) < MAX_OFFSET * frame.diagonal &&
                   distance(way, ray.direction) < MAX_TURN;
  vec4 place = frame.viewProjection * vec4(ray.origin, 1.0);
  if (!reflected || place.w <= 0.0) return true;
  ivec2 screen = ivec2(frame.width, frame.height);
  ivec2 pixel = ivec2(floor((0.5 * place.xy / place.w + 0.5) * vec2(screen)));
  uint last = 0u;
  for (int i = 0; i < 9; ++i) {
    ivec2 other = pixel + ivec2(i % 3, i / 3) - 1;
    if (any(lessThan(other, ivec2(0))) || any(greaterThanEqual(other, screen))) continue;
    uint seen = texelFetch(mirrored, other, 0).x;
    if (seen == 0u || seen == last) continue;
    last = seen;
    countTest();
    testCandidate(ray, seen - 1u, best);
  }
  return true;
}

void storeSurface(uint index, Hit hit) {}
