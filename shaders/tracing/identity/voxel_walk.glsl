// The identity method's walk, in units of voxels and without divisions: a ray crosses plane x of an axis at
// x * inverse + offset. Steps go through cubes of voxels, single ones or whole bricks.
#include "shared/passes/identity.h"
#include "tracing/common/grid.glsl"
#include "tracing/common/walk.glsl"
#include "tracing/identity/bricks.glsl"
#include "tracing/identity/entry.glsl"

struct VoxelRay {
  vec3 origin, direction;
  vec3 inverse, offset;
  ivec3 ahead;  // 1 if the ray meets the upper boundaries of an axis, 0 the lower ones
};

VoxelRay makeVoxelRay(TraceRay ray) {
  VoxelRay v;
  v.origin = ray.gridOrigin * vec3(voxelCount);
  v.direction = ray.gridDirection * vec3(voxelCount);
  // An axis along which the ray stays in its voxel is never crossed; smaller directions have no finite inverse.
  bvec3 still = lessThan(abs(v.direction), vec3(1e-30));
  v.inverse = mix(1.0 / v.direction, vec3(0.0), still);
  v.offset = mix(-v.origin * v.inverse, vec3(farAway), still);
  v.ahead = ivec3(greaterThan(v.direction, vec3(0.0)));
  return v;
}

ivec3 voxelAt(VoxelRay v, float t) {
  precise vec3 at = v.origin + v.direction * t;
  return ivec3(floor(at));
}

// A waiting ray keeps its voxel (at most 512 along an axis), so that it comes back to it whatever rounding makes of t.
uint packVoxel(ivec3 voxel) { return 0x80000000u | uint(voxel.x | voxel.y << 10 | voxel.z << 20); }
ivec3 resumedVoxel(VoxelRay v, PausedRay pause) {
  if (pause.own != 0u) return (ivec3(pause.own) >> ivec3(0, 10, 20)) & 0x3ff;
  return clamp(voxelAt(v, pause.t), ivec3(0), voxelCount - 1);
}

bool inGrid(ivec3 voxel) { return all(lessThan(uvec3(voxel), uvec3(voxelCount))); }

struct Cube {
  ivec3 low;
  int side;        // voxels
  vec3 crossings;  // of the boundaries ahead, per axis
};

Cube makeCube(VoxelRay v, ivec3 low, int side) {
  // Every program must find the same way.
  precise vec3 crossings = vec3(low + v.ahead * side) * v.inverse + v.offset;
  return Cube(low, side, crossings);
}

// Of the eight directions, a bit per axis, the one that the ray goes in.
uint octantOf(VoxelRay v) { return uint(v.ahead.x | v.ahead.y << 1 | v.ahead.z << 2); }

// Cubes of whole bricks, the first of which is that of a voxel: the brick, or the empty cube that it begins on the ray's
// way.
Cube bricksAhead(VoxelRay v, ivec3 voxel, int side) {
  ivec3 low = brickOf(voxel) - (side - 1) * (1 - v.ahead);
  return makeCube(v, low << BRICK_SHIFT, side << BRICK_SHIFT);
}
Cube brickCube(VoxelRay v, ivec3 voxel) { return bricksAhead(v, voxel, 1); }
Cube emptyCube(VoxelRay v, uint octant, ivec3 voxel, uint state) {
  return bricksAhead(v, voxel, emptySide(state, octant));
}

float exitOf(Cube cube) { return min(cube.crossings.x, min(cube.crossings.y, cube.crossings.z)); }

// The first voxel behind the cube, which may be outside the grid.
ivec3 voxelBehind(VoxelRay v, Cube cube) {
  vec3 c = cube.crossings;
  bool x = c.x <= c.y && c.x <= c.z, y = !x && c.y <= c.z;
  ivec3 last = clamp(voxelAt(v, exitOf(cube)), cube.low, cube.low + (cube.side - 1));
  return mix(last, cube.low + v.ahead * (cube.side + 1) - 1, bvec3(x, y, !x && !y));
}

// What the halves of the ray's way through a voxel, from `t` to `exit`, lie in: boxes as entries have them.
uvec2 boxesOf(VoxelRay v, ivec3 voxel, float t, float exit) {
  vec3 from = v.origin + v.direction * t - vec3(voxel), to = v.origin + v.direction * exit - vec3(voxel);
  vec3 middle = 0.5 * (from + to);
  return uvec2(boxBits(min(from, middle), max(from, middle)), boxBits(min(middle, to), max(middle, to)));
}
