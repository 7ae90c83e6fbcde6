// Which triangle a texel of the cube sees. Compiled with ALPHA_TEST for materials with holes.
#include "tracing/cubemap/faces.glsl"
#ifdef ALPHA_TEST
#include "lib/alpha.glsl"
#include "lib/triangle_point.glsl"
#endif

uniform int face;
uniform int resolution;

layout(location = 0) flat in uint triangle;
layout(location = 0) out uint visible;

void main() {
#ifdef ALPHA_TEST
  vec3 way = texelWay(ivec2(gl_FragCoord.xy), face, resolution);
  if (cutAway(triangle, pointOnTriangle(triangle, probe.xyz, way).barycentrics)) discard;
#endif
  visible = triangle + 1u;
}
