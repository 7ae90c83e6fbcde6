// Tracing of one ray of the queue by the method's march(): 3D-DDA through the voxels and a search in occupied ones. Entry
// points: trace.comp and trace.frag, which share every line (tests hold them to the same bits).
#include "shared/bindings.h"
#include "shared/structs.h"
#include "lib/frame.glsl"
#include "lib/when.glsl"
#include "lib/scene.glsl"
#include "lib/textures.glsl"
#include "lib/alpha.glsl"
#include "tracing/grid.glsl"
#define VOXEL_ACCESS readonly
#include "tracing/voxel_store.glsl"
#include "tracing/ray_triangle.glsl"
#include "tracing/walk.glsl"

layout(std430, binding = SSBO_RAYS) readonly buffer RayBlock { Ray rays[]; };
layout(std430, binding = SSBO_RAY_COUNT) coherent buffer RayCountBlock { RayCount rayCount; };
layout(std430, binding = SSBO_HITS) buffer HitBlock { Hit hits[]; };
layout(std430, binding = SSBO_PAUSED) buffer PausedBlock { PausedRay paused[]; };

// Some drivers stop all loops of a shader, silently, after a number of iterations (65,535 on Mesa's llvmpipe, summed
// over the rays that run in one vector). So a ray that has done `workLimit` of them leaves the rest to the next
// dispatch (`resuming`); every loop notices when it was stopped from outside (`cut`), and the ray then goes on from the
// last voxel that it had done. What the last dispatch leaves is given up, counted and marked, like a ray that came by
// a texel with lost fragments.
uniform int workLimit;
uniform int resuming;
uniform int lastDispatch;
bool cut = false;
bool incomplete = false;  // the ray came by something that is missing from the structure

#ifdef METHOD_IDENTITY
#include "tracing/identity.glsl"
#endif
#ifdef METHOD_ATTRIBUTES
#include "tracing/attributes.glsl"
#endif

void traceRay(uint index) {
  PausedRay pause = PausedRay(0.0, 0u, 0u, 0u);
  if (resuming == 1) {
    if (hits[index].triangle != UNFINISHED_TRIANGLE) return;
    pause = paused[index];
  }
  Ray queued = rays[index];
  TraceRay ray;
  ray.origin = queued.origin;
  ray.direction = queued.direction;
  ray.gridOrigin = toGrid(ray.origin);
  ray.gridDirection = ray.direction * gridInverse;
  ray.excluded = queued.excluded;
  ray.least = frame.minDistance;
  ray.shear = makeShear(ray.direction);

  Hit best = Hit(farAway, NO_TRIANGLE, 0.0, 0.0);
  vec2 range = gridRange(ray);
  pause.t = max(range.x, pause.t);
  if (!march(ray, min(range.y, queued.maxDistance), pause, best)) {
    if (lastDispatch == 0) {
      hits[index] = Hit(HIT_NOT_TRACED, UNFINISHED_TRIANGLE, 0.0, 0.0);
      paused[index] = pause;
      atomicAdd(rayCount.unfinished, 1u);
      return;
    }
    incomplete = true;
  }
  if (incomplete) {
    atomicAdd(rayCount.overflow, 1u);
    best = Hit(HIT_OVERFLOW, NO_TRIANGLE, 0.0, 0.0);
  }
  if (best.t > queued.maxDistance || best.t == farAway) best = Hit(HIT_MISS, NO_TRIANGLE, 0.0, 0.0);
  hits[index] = best;
  storeSurface(index, best);
}
