// `precise`, here and in the tests of texels: what a build counts it has to find again when it stores.
//
// The projections in which a triangle is rasterized: along its own dominant axis, or along all three.
#include "tracing/common/grid.glsl"
#include "tracing/common/triangle_normal.glsl"

#ifdef BUILD_STEP
// The step of a build, and its projections. They are in a uniform block (bound to BUILD_STEP) because some drivers
// recompile a program for the values of plain uniforms that decide branches; the two steps must run the same code.
layout(std140, binding = BUILD_STEP) uniform BuildStepBlock {
  int secondStep;  // 0: entries are counted, 1: stored
  int ownAxis;     // 1: each triangle in its own dominant axis
};
#else
uniform int ownAxis;  // 1: each triangle in its own dominant axis
#endif

// A triangle seen along an axis, which is the last component.
struct ProjectedTriangle {
  vec3 a, b, c;  // grid space
  int axis;
};

int projectionCount() { return ownAxis == 1 ? 1 : 3; }

// In world space: `a`, `b`, `c`.
ProjectedTriangle projectAlong(vec3 a, vec3 b, vec3 c, int axis) {
  precise vec3 pa = permute(toGrid(a), axis), pb = permute(toGrid(b), axis), pc = permute(toGrid(c), axis);
  return ProjectedTriangle(pa, pb, pc, axis);
}

// One of a triangle's projections.
ProjectedTriangle projectTriangle(vec3 a, vec3 b, vec3 c, int number) {
  return projectAlong(a, b, c, ownAxis == 1 ? dominantAxis(gridNormal(a, b, c)) : number);
}
