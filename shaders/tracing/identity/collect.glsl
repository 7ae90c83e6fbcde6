// Lists triangles for a build.
#include "shared/passes/listed_triangles.h"
#include "tracing/common/listed_triangles.glsl"
#include "tracing/common/small_triangle.glsl"

layout(local_size_x = TRIANGLE_GROUP) in;

uniform uint triangleCount;

// `a`, `b`, `c` in world space.
void listTriangle(uint triangle, vec3 a, vec3 b, vec3 c) {
  if (isSmall(a, b, c))
    listSmallTriangle(triangle);
  else
    listLargeTriangle(triangle);
}
