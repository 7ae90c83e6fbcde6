// Search in a voxel for the methods that store attributes (Hu et al. 2014, section 3.2): linear search for the first
// point of the ray that lies inside an object, by the depths of the fragments in each point's texel, then binary search
// back to where the ray went in. LINEAR_STEPS > 0 takes that many equal steps; 0 visits every texel (full 2D-DDA).
#include "shared/passes/trace.h"
#include "shared/rays.h"
#include "shared/structs.h"
#include "tracing/attributes/entry.glsl"
#include "tracing/attributes/fragments.glsl"
#include "tracing/common/grid.glsl"
#include "tracing/common/ray_work.glsl"
#include "tracing/common/trace_state.glsl"
#include "tracing/common/voxel_store.glsl"
#include "tracing/common/walk.glsl"
#ifdef DEPTH_TEST
#include "tracing/attributes/depth_test.glsl"
#else
#include "tracing/attributes/plane_test.glsl"
#endif

layout(std430, binding = SSBO_HIT_SURFACES) writeonly buffer HitSurfaceBlock { HitSurface hitSurfaces[]; };
uniform int refinements;
uint foundFragment = noFragment;

// Narrows a crossing down; keeps it if it is nearer than `best`.
void refine(TraceRay ray, Slab slab, Sample a, Sample b, inout Hit best, inout int work) {
  for (int i = 0; i < refinements; ++i) {
    float t = 0.5 * (a.t + b.t);
    Sample middle = sampleAt(ray, slab, t, texelAt(ray, slab.axis, t), work);
    if (crossed(ray, slab.axis, a, middle))
      b = middle;
    else
      a = middle;
  }
  uint fragment;
  float t = settle(ray, slab.axis, a, b, fragment);
  if (fragment == noFragment || t < ray.least || t >= best.t) return;
  best = Hit(t, triangleOf(fragment), 0.0, 0.0);
  foundFragment = fragment;
}

void searchBuffer(TraceRay ray, int axis, float begin, float end, inout Hit best, inout int work) {
  vec2 depths = vec2(permute(ray.gridOrigin + ray.gridDirection * begin, axis).z,
                     permute(ray.gridOrigin + ray.gridDirection * end, axis).z);
  // The voxel's own range, and a texel more: a surface's fragment may lie just across the border.
  float layers = float(voxelCount[axis]);
  float layer = floor(0.5 * (depths.x + depths.y) * layers);
  Slab slab = Slab(axis, vec2(layer, layer + 1.0) / layers + vec2(-1.0, 1.0) / float(bufferResolution));

  float known = best.t;
  Sample last = sampleAt(ray, slab, begin, texelAt(ray, axis, begin), work);
  if (startsInside(ray, last)) {
    best = Hit(begin, uint(last.nearestTriangle), 0.0, 0.0);
    foundFragment = last.nearest;
    return;
  }
#if LINEAR_STEPS > 0
  for (int i = 1; i <= LINEAR_STEPS; ++i) {
    float t = begin + (end - begin) * float(i) / float(LINEAR_STEPS);
    Sample next = sampleAt(ray, slab, t, texelAt(ray, axis, t), work);
    if (crossed(ray, slab.axis, last, next)) refine(ray, slab, last, next, best, work);
    if (best.t < known) break;
    last = next;
  }
#else
  TexelWalk walk = startTexelWalk(ray, axis, begin);
  float enter = begin;
  bool going = true;
  while (going) {
    float exit = min(walkExit(walk), end);
    // The middle of the texel's stretch; in the last texel its end, so that the whole stretch is looked at.
    float t = exit < end ? 0.5 * (enter + exit) : end;
    Sample next = sampleAt(ray, slab, max(t, last.t), walk.texel, work);
    if (crossed(ray, slab.axis, last, next)) refine(ray, slab, last, next, best, work);
    last = next;
    enter = exit;
    going = !cut && best.t >= known && exit < end && stepTexelWalk(walk);
  }
  if (going) cut = true;
#endif
}

// From voxel to voxel until one answers: one surface per voxel is the methods' assumption, and the first one found ends
// the search. False if the ray is not through; `pause` then says how to go on.
bool march(TraceRay ray, float end, inout PausedRay pause, inout Hit best) {
  incomplete = pause.own != 0u;
  float t = pause.t;
  int work = 0;
  bool yielded = false;
  bool going = t < end;
  VoxelWalk walk = startVoxelWalk(ray, t);
  while (going) {
    countStep();
    float exit = max(t, min(voxelExit(walk), end));
    for (uint mask = voxelMask(walk.voxel); mask != 0u; mask &= mask - 1u)
      searchBuffer(ray, findLSB(mask), t, exit, best, work);
    going = best.t == farAway && !cut && exit < end && stepVoxelWalk(ray, walk);
    if (going) {
      t = exit;
      yielded = ++work >= workLimit;
      going = !yielded;
    }
  }
  pause.t = t;
  pause.own = incomplete ? 1u : 0u;
  return !(cut || yielded || going);
}

void storeSurface(uint index, Hit hit) {
  HitSurface surface = HitSurface(vec3(0.0), 0.0, vec3(0.0), 0.0);
  if (hit.t >= 0.0) {
    surface.baseColor = imageLoad(pool, int(foundFragment) * ENTRY_TEXELS).xyz;
    vec4 stored = unpackNormalReflectivity(imageLoad(pool, int(foundFragment) * ENTRY_TEXELS + 1));
    surface.normal = stored.xyz;
    surface.reflectivity = stored.w;
  }
  hitSurfaces[index] = surface;
}
