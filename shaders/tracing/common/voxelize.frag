// Marks the voxels of fragments, see mark_triangle.glsl.
#include "lib/triangles.glsl"
#include "tracing/common/grid.glsl"
#include "tracing/common/mark_triangle.glsl"
#include "tracing/common/projections.glsl"
#include "tracing/common/shifted_edges.glsl"
#ifdef CONSERVATIVE
#include "tracing/common/touched_voxels.glsl"
#else
uniform int rasterResolution;
#ifndef SHIFTED
layout(location = 2) in float inDepth;
#endif
#endif

layout(location = 0) flat in uint inTriangle;
layout(location = 1) flat in int inAxis;

void visitVoxel(ivec3 voxel) { markTriangle(voxel, inTriangle, inAxis); }

// Of a fragment with one depth.
void visitAt(ivec2 column, float depth) {
  ivec3 voxels = permutedVoxels(inAxis);
  int layer = clamp(int(floor(depth * float(voxels.z))), 0, voxels.z - 1);
  visitVoxel(ivec3(unpermute(vec3(column, layer), inAxis)));
}

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
#if defined(CONSERVATIVE) || defined(SHIFTED)
  vec3 a, b, c;
  trianglePositions(inTriangle, a, b, c);
  ProjectedTriangle projected = projectAlong(a, b, c, inAxis);
#endif
#ifdef CONSERVATIVE
  visitTouchedVoxels(projected, texel);
#elif defined(SHIFTED)
  float resolution = float(rasterResolution);
  if (inGrownBox(projected, texel, resolution)) visitAt(texel, depthInTexel(projected, texel, resolution));
#else
  visitAt(columnOf(texel, permutedVoxels(inAxis).xy, rasterResolution), inDepth);
#endif
}
