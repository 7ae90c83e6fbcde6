// Marks the voxels of fragments, see mark_triangle.glsl.
#include "lib/triangles.glsl"
#include "tracing/common/grid.glsl"
#include "tracing/common/mark_triangle.glsl"
#ifdef CONSERVATIVE
#include "tracing/common/projections.glsl"
#include "tracing/common/touched_voxels.glsl"
#else
uniform int rasterResolution;
layout(location = 2) in float inDepth;
#endif

layout(location = 0) flat in uint inTriangle;
layout(location = 1) flat in int inAxis;

void visitVoxel(ivec3 voxel) { markTriangle(voxel, inTriangle, inAxis); }

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
#ifdef CONSERVATIVE
  vec3 a, b, c;
  trianglePositions(inTriangle, a, b, c);
  visitTouchedVoxels(projectAlong(a, b, c, inAxis), texel);
#else
  ivec3 voxels = permutedVoxels(inAxis);
  ivec2 column = texel * voxels.xy / rasterResolution;
  int depth = clamp(int(floor(inDepth * float(voxels.z))), 0, voxels.z - 1);
  visitVoxel(ivec3(unpermute(vec3(column, depth), inAxis)));
#endif
}
