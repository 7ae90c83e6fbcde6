// Which triangle a pixel's mirrored ray sees. Compiled with ALPHA_TEST for materials with holes.
#include "lib/frame.glsl"
#include "tracing/planar/mirrored.glsl"
#ifdef ALPHA_TEST
#include "lib/alpha.glsl"
#include "lib/triangle_point.glsl"
#endif

layout(location = 0) flat in uint triangle;
layout(location = 1) in float before;
layout(location = 0) out uint visible;

void main() {
  if (before <= 0.0) discard;
#ifdef ALPHA_TEST
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec3 origin = mirroredPoint(pixelOrigin(pixel)), way = mirroredDirection(pixelRay(pixel));
  if (cutAway(triangle, pointOnTriangle(triangle, origin, way).barycentrics)) discard;
#endif
  visible = triangle + 1u;
}
