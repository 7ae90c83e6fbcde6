// The voxels of one brick that a triangle touches, as a set: a bit each, at its number in the brick.
#include "shared/passes/identity.h"
#include "tracing/common/projections.glsl"
#include "tracing/common/small_triangle.glsl"
#include "tracing/common/touched_depths.glsl"

uvec2 voxelBit(uint number) {
  uint bit = 1u << (number & 31u);
  return number < 32u ? uvec2(bit, 0u) : uvec2(0u, bit);
}

uvec2 touchedInBrick(ProjectedTriangle t, ivec3 brick) {
  ivec3 corner = ivec3(permute(vec3(brick << BRICK_SHIFT), t.axis));
  // How numbers in the brick grow along the projection's axes.
  ivec3 stride = ivec3(permute(vec3(1, BRICK_SIDE, BRICK_SIDE * BRICK_SIDE), t.axis));
  TexelBox box = texelBox(t);
  ivec2 first = max(box.low, corner.xy), size = max(min(box.low + box.size, corner.xy + BRICK_SIDE) - first, 0);
  ivec2 texel = first;
  uvec2 voxels = uvec2(0u);
  for (int left = size.x * size.y; left > 0; --left) {
    ivec2 depths = touchedDepths(t, texel) - corner.z, at = (texel - corner.xy) * stride.xy;
    for (int depth = 0; depth < BRICK_SIDE; ++depth) {
      if (depth >= depths.x && depth <= depths.y) voxels |= voxelBit(uint(at.x + at.y + depth * stride.z));
    }
    ++texel.x;
    if (texel.x == first.x + size.x) texel = ivec2(first.x, texel.y + 1);
  }
  return voxels;
}

// Takes the lowest voxel, of at least one, out of the set.
uint takeVoxel(inout uvec2 voxels) {
  bool low = voxels.x != 0u;
  uint number = uint(findLSB(low ? voxels.x : voxels.y));
  if (low)
    voxels.x &= voxels.x - 1u;
  else
    voxels.y &= voxels.y - 1u;
  return number + (low ? 0u : 32u);
}
