// The entries of the small triangles.
#include "tracing/identity/each_small.glsl"
#include "tracing/identity/add_entry.glsl"

void visitVoxel(ivec3 voxel) { addEntry(voxel, triangle, projected.axis); }
void endProjection() {
  countEntries(projected.axis, ivec2(gl_LocalInvocationIndex % 8u, gl_LocalInvocationIndex / 8u));
}
