// The walk of a ray through the blocks and texels of one axis (DDA on two levels). Every boundary is computed from the
// ray itself, as in tracing/common/walk.glsl.
#include "tracing/common/walk.glsl"
#include "tracing/depth_cube/cube.glsl"

struct CubeWalk {
  int axis;
  vec3 origin, direction;  // the ray's, in the grid, the axis last
  bool inBlock;            // the cell is a texel, else a block
  ivec2 cell;
  vec2 boundary;  // parameters of the boundaries ahead
  float t;        // where the ray enters the cell
};

float cellSize(CubeWalk walk) { return walk.inBlock ? 1.0 : float(blockSize); }

void aim(inout CubeWalk walk) {
  float cells = float(bufferResolution) / cellSize(walk);
  walk.boundary = vec2(boundaryAhead(walk.origin.x, walk.direction.x, walk.cell.x, cells),
                       boundaryAhead(walk.origin.y, walk.direction.y, walk.cell.y, cells));
}

ivec2 texelOf(CubeWalk walk, float t) {
  vec2 at = (walk.origin.xy + walk.direction.xy * t) * float(bufferResolution);
  return clamp(ivec2(floor(at)), ivec2(0), ivec2(bufferResolution - 1));
}

CubeWalk startCubeWalk(TraceRay ray, int axis, float t) {
  CubeWalk walk = CubeWalk(axis, permute(ray.gridOrigin, axis), permute(ray.gridDirection, axis), false, ivec2(0),
                           vec2(0.0), t);
  walk.cell = texelOf(walk, t) / blockSize;
  aim(walk);
  return walk;
}

float cubeExit(CubeWalk walk) { return max(walk.t, min(walk.boundary.x, walk.boundary.y)); }

// From a block to its texel where the ray is.
void enterBlock(inout CubeWalk walk) {
  ivec2 first = walk.cell * blockSize;
  walk.inBlock = true;
  walk.cell = clamp(texelOf(walk, walk.t), first, min(first + blockSize, ivec2(bufferResolution)) - 1);
  aim(walk);
}

// To the next cell, and from the last texel of a block to the next block. False when the ray leaves the images.
bool stepCubeWalk(inout CubeWalk walk) {
  walk.t = cubeExit(walk);
  int across = walk.boundary.x <= walk.boundary.y ? 0 : 1;
  ivec2 block = walk.cell / blockSize;
  walk.cell[across] += walk.direction[across] > 0.0 ? 1 : -1;
  int last = walk.inBlock ? bufferResolution : blocksAlong();
  bool inside = walk.cell[across] >= 0 && walk.cell[across] < last;
  if (walk.inBlock && inside && walk.cell / blockSize != block) {
    walk.inBlock = false;
    walk.cell /= blockSize;
  }
  aim(walk);
  return inside;
}
