// The bricks that small moved triangles come to.
#include "tracing/identity/each_small.glsl"
#include "tracing/identity/mark_moved.glsl"

void visitVoxel(ivec3 brick) { markMoved(brick, projected.axis); }
void endProjection() {}
