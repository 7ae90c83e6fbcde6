// The entries of the large triangles.
#include "lib/triangles.glsl"
#include "tracing/common/projections.glsl"
#include "tracing/common/touched_voxels.glsl"
#include "tracing/identity/add_entry.glsl"

layout(location = 0) flat in uint inTriangle;
layout(location = 1) flat in int inAxis;

void visitVoxel(ivec3 voxel) { addEntry(voxel, inTriangle, inAxis); }

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  vec3 a, b, c;
  trianglePositions(inTriangle, a, b, c);
  visitTouchedVoxels(projectAlong(a, b, c, inAxis), texel);
  countEntries(inAxis, texel);
}
