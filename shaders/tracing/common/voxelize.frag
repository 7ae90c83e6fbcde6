// Marks voxels with the axis of their triangles (ACCUMULATE off: each triangle's own axis), or sums up normals for the
// dominant axis (Hu et al. 2014, section 3.1; Kastrati & Goswami 2017, section 3.2.1). The sums are fixed-point
// integers: unlike a moving average they do not depend on the order of the fragments.
#include "shared/passes/voxelize.h"
#include "shared/tracing.h"
#include "lib/triangles.glsl"
#include "tracing/common/grid.glsl"
#include "tracing/common/mark_voxel.glsl"
#include "tracing/common/texel_overlap.glsl"
#include "tracing/common/triangle_normal.glsl"

#ifdef ACCUMULATE
layout(std430, binding = SSBO_NORMAL_X) buffer NormalX { int normalX[]; };
layout(std430, binding = SSBO_NORMAL_Y) buffer NormalY { int normalY[]; };
layout(std430, binding = SSBO_NORMAL_Z) buffer NormalZ { int normalZ[]; };
uniform int absoluteNormals;  // 1: votes by area, 0: signed normals
#endif

uniform int rasterResolution;

layout(location = 0) flat in uint inTriangle;
layout(location = 1) flat in int inAxis;
layout(location = 2) in float inDepth;

void visitVoxel(ivec3 voxel) {
#ifdef ACCUMULATE
  vec3 a, b, c;
  trianglePositions(inTriangle, a, b, c);
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
  markVoxel(voxel, 1u << uint(inAxis));
#endif
}

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
#ifdef CONSERVATIVE
  vec3 a, b, c;
  trianglePositions(inTriangle, a, b, c);
  visitTouchedVoxels(a, b, c, inAxis, texel);
#else
  ivec3 voxels = permutedVoxels(inAxis);
  ivec2 column = texel * voxels.xy / rasterResolution;
  int depth = clamp(int(floor(inDepth * float(voxels.z))), 0, voxels.z - 1);
  visitVoxel(ivec3(unpermute(vec3(column, depth), inAxis)));
#endif
}
