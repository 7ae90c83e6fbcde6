// Voxels alone (Hu et al. 2014, figure 9, after Papaioannou et al. 2010): a ray hits the first occupied voxel on its
// way, where it enters it.
#include "lib/scene.glsl"
#include "lib/triangles.glsl"
#include "shared/passes/trace.h"
#include "shared/passes/voxelize.h"
#include "shared/passes/voxels.h"
#include "shared/rays.h"
#include "shared/structs.h"
#include "tracing/common/packed_unit.glsl"
#include "tracing/common/ray_work.glsl"
#include "tracing/common/trace_state.glsl"
#include "tracing/common/walk.glsl"

layout(std430, binding = SSBO_VOXEL_TRIANGLES) readonly buffer TriangleOfVoxel { uint voxelTriangles[]; };
layout(std430, binding = SSBO_VOXEL_SURFACES) readonly buffer SurfaceBlock { VoxelSurface voxelSurfaces[]; };
layout(std430, binding = SSBO_HIT_SURFACES) writeonly buffer HitSurfaceBlock { HitSurface hitSurfaces[]; };

uint found = 0u;

// The voxels around a ray's origin hold the surface that it leaves; those of double-sided ones may a little farther on.
// Single-sided surfaces are hit where they face the ray.
bool counts(TraceRay ray, uint index, float t) {
  uint triangle = voxelTriangles[index];
  if (triangle == NO_TRIANGLE || t < ray.least || near(t, 2.0)) return false;
  bool mayShowBacks = !near(t, 4.0) && doubleSided(triangleAt(triangle).w);
  return mayShowBacks || dot(unpackUnit(voxelSurfaces[index].normal), ray.direction) < 0.0;
}

bool march(TraceRay ray, float end, inout PausedRay pause, inout Hit best) {
  int work = 0;
  bool yielded = false, going = pause.t < end;
  VoxelWalk walk = startVoxelWalk(ray, pause.t);
  while (going) {
    countStep();
    uint index = voxelIndex(walk.voxel);
    if (counts(ray, index, pause.t)) {
      best = Hit(pause.t, voxelTriangles[index], 0.0, 0.0);
      found = index;
      going = false;
    } else {
      float exit = max(pause.t, min(voxelExit(walk), end));
      going = exit < end && stepVoxelWalk(ray, walk);
      if (going) {
        pause.t = exit;
        yielded = ++work >= workLimit;
        going = !yielded;
      }
    }
  }
  return !yielded;
}

void storeSurface(uint index, Hit hit) {
  HitSurface surface = HitSurface(vec3(0.0), 0.0, vec3(0.0), 0.0);
  if (hit.t >= 0.0) {
    vec4 color = unpackUnorm4x8(voxelSurfaces[found].color);
    surface.baseColor = color.rgb * color.rgb;
    surface.reflectivity = color.a * color.a;
    surface.normal = unpackUnit(voxelSurfaces[found].normal);
  }
  hitSurfaces[index] = surface;
}
