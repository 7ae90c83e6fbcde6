// Marks voxels with the axis of their triangles (ACCUMULATE off: each triangle's own axis), or sums up normals for the
// dominant axis (Hu et al. 2014, section 3.1; Kastrati & Goswami 2017, section 3.2.1). The sums are fixed-point
// integers: unlike a moving average they do not depend on the order of the triangles.
#include "lib/triangles.glsl"
#include "shared/passes/voxelize.h"
#include "shared/tracing.h"
#include "tracing/common/grid.glsl"
#include "tracing/common/mark_voxel.glsl"
#include "tracing/common/triangle_normal.glsl"

#ifdef ACCUMULATE
layout(std430, binding = SSBO_NORMAL_X) buffer NormalX { int normalX[]; };
layout(std430, binding = SSBO_NORMAL_Y) buffer NormalY { int normalY[]; };
layout(std430, binding = SSBO_NORMAL_Z) buffer NormalZ { int normalZ[]; };
uniform int absoluteNormals;  // 1: votes by area, 0: signed normals
#endif

#ifdef KEEP_TRIANGLES
layout(std430, binding = SSBO_VOXEL_TRIANGLES) buffer TriangleOfVoxel { uint voxelTriangles[]; };
#endif

// A voxel that a triangle, seen along `axis`, has a fragment in.
void markTriangle(ivec3 voxel, uint triangle, int axis) {
#ifdef KEEP_TRIANGLES
  atomicMin(voxelTriangles[voxelIndex(voxel)], triangle);
#endif
#ifdef ACCUMULATE
  vec3 a, b, c;
  trianglePositions(triangle, a, b, c);
  vec3 normal = unitOrZero(gridNormal(a, b, c));
  if (absoluteNormals == 1) normal = abs(normal);
  ivec3 votes = ivec3(round(normal * NORMAL_SCALE));
  uint index = voxelIndex(voxel);
  atomicAdd(normalX[index], votes.x);
  atomicAdd(normalY[index], votes.y);
  atomicAdd(normalZ[index], votes.z);
  // A voxel is occupied even if its normals cancel; voxel_axis.comp replaces the mark by the dominant axis.
  markVoxel(voxel, 7u);
#else
  markVoxel(voxel, 1u << uint(axis));
#endif
}
