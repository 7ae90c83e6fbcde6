// Walks of a ray through voxels and texels (3D-DDA and 2D-DDA, Amanatides & Woo 1987). Every boundary is computed from
// the ray itself instead of summed up, so that errors do not grow along the way.
#include "shared/rays.h"
#include "tracing/common/grid.glsl"
#include "tracing/common/ray_triangle.glsl"

const float farAway = FAR_AWAY;

struct TraceRay {
  vec3 origin, direction;      // world
  vec3 gridOrigin, gridDirection;
  uint excluded;               // triangle that the ray starts on
  float least, most;           // hits nearer or farther are none, meters
  RayShear shear;
};

// Parameter at which the ray crosses the boundary ahead of cell index `cell` of `resolution` cells.
float boundaryAhead(float origin, float direction, int cell, float resolution) {
  if (direction == 0.0) return farAway;
  return (float(direction > 0.0 ? cell + 1 : cell) / resolution - origin) / direction;
}

ivec3 voxelAt(TraceRay ray, float t) {
  vec3 at = (ray.gridOrigin + ray.gridDirection * t) * vec3(voxelCount);
  return clamp(ivec3(floor(at)), ivec3(0), voxelCount - 1);
}

// Whether the ray is within so many voxels of its origin: there it sees the surface that it leaves in other texels and
// voxels than its own.
bool near(float t, float voxels) {
  vec3 voxelsPerMetre = vec3(voxelCount) * gridInverse;
  return t * max(voxelsPerMetre.x, max(voxelsPerMetre.y, voxelsPerMetre.z)) <= voxels;
}

struct VoxelWalk {
  ivec3 voxel;
  vec3 boundary;  // parameter of the boundary ahead, per axis
};

VoxelWalk startVoxelWalk(TraceRay ray, float t) {
  VoxelWalk walk;
  walk.voxel = voxelAt(ray, t);
  for (int i = 0; i < 3; ++i)
    walk.boundary[i] = boundaryAhead(ray.gridOrigin[i], ray.gridDirection[i], walk.voxel[i], float(voxelCount[i]));
  return walk;
}

float voxelExit(VoxelWalk walk) { return min(walk.boundary.x, min(walk.boundary.y, walk.boundary.z)); }

// False when the ray leaves the grid.
bool stepVoxelWalk(TraceRay ray, inout VoxelWalk walk) {
  vec3 ahead = walk.boundary;
  int axis = ahead.x <= ahead.y && ahead.x <= ahead.z ? 0 : (ahead.y <= ahead.z ? 1 : 2);
  walk.voxel[axis] += ray.gridDirection[axis] > 0.0 ? 1 : -1;
  walk.boundary[axis] =
      boundaryAhead(ray.gridOrigin[axis], ray.gridDirection[axis], walk.voxel[axis], float(voxelCount[axis]));
  return walk.voxel[axis] >= 0 && walk.voxel[axis] < voxelCount[axis];
}

struct TexelWalk {
  ivec2 texel;
  vec2 boundary;
  vec2 origin, direction;  // grid units
  float depth, depthStep;  // depth = depth + depthStep * t
};

TexelWalk startTexelWalk(TraceRay ray, int axis, float t) {
  vec3 origin = permute(ray.gridOrigin, axis), direction = permute(ray.gridDirection, axis);
  float n = float(bufferResolution);
  TexelWalk walk;
  walk.origin = origin.xy;
  walk.direction = direction.xy;
  walk.depth = origin.z;
  walk.depthStep = direction.z;
  walk.texel = clamp(ivec2(floor((walk.origin + walk.direction * t) * n)), ivec2(0), ivec2(bufferResolution - 1));
  walk.boundary = vec2(boundaryAhead(walk.origin.x, walk.direction.x, walk.texel.x, n),
                       boundaryAhead(walk.origin.y, walk.direction.y, walk.texel.y, n));
  return walk;
}

float walkExit(TexelWalk walk) { return min(walk.boundary.x, walk.boundary.y); }

bool stepTexelWalk(inout TexelWalk walk) {
  int axis = walk.boundary.x <= walk.boundary.y ? 0 : 1;
  walk.texel[axis] += walk.direction[axis] > 0.0 ? 1 : -1;
  walk.boundary[axis] =
      boundaryAhead(walk.origin[axis], walk.direction[axis], walk.texel[axis], float(bufferResolution));
  return walk.texel[axis] >= 0 && walk.texel[axis] < bufferResolution;
}

// Parameters at which the ray enters and leaves the grid; empty when x > y.
vec2 gridRange(TraceRay ray) {
  vec2 range = vec2(0.0, farAway);
  for (int i = 0; i < 3; ++i) {
    float o = ray.gridOrigin[i], d = ray.gridDirection[i];
    if (d == 0.0) {
      if (o < 0.0 || o > 1.0) range = vec2(1.0, 0.0);
      continue;
    }
    float t0 = -o / d, t1 = (1.0 - o) / d;
    range = vec2(max(range.x, min(t0, t1)), min(range.y, max(t0, t1)));
  }
  return range;
}
