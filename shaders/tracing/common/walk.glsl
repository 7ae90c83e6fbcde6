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
  float least;                 // hits nearer are ignored, metres
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

// A cube of voxels that the ray goes through in one step; `size` divides the grid. Its boundaries are the outermost
// voxels' to the bit if `size` is a power of two.
struct Cell {
  ivec3 low;
  int size;
  vec3 boundary;  // parameter of the boundary ahead, per axis
};

Cell cellAround(TraceRay ray, ivec3 voxel, int size) {
  Cell cell;
  ivec3 number = voxel / size;
  cell.low = number * size;
  cell.size = size;
  for (int i = 0; i < 3; ++i)
    cell.boundary[i] =
        boundaryAhead(ray.gridOrigin[i], ray.gridDirection[i], number[i], float(voxelCount[i]) / float(size));
  return cell;
}

float cellExit(Cell cell) { return min(cell.boundary.x, min(cell.boundary.y, cell.boundary.z)); }

// On to the voxel behind the cell; false when the ray leaves the grid.
bool leaveCell(TraceRay ray, Cell cell, inout ivec3 voxel) {
  vec3 ahead = cell.boundary;
  int axis = ahead.x <= ahead.y && ahead.x <= ahead.z ? 0 : (ahead.y <= ahead.z ? 1 : 2);
  voxel = clamp(voxelAt(ray, ahead[axis]), cell.low, cell.low + cell.size - 1);
  voxel[axis] = ray.gridDirection[axis] > 0.0 ? cell.low[axis] + cell.size : cell.low[axis] - 1;
  return voxel[axis] >= 0 && voxel[axis] < voxelCount[axis];
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
