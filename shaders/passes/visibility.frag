// Which triangle a pixel sees. Compiled with ALPHA_TEST for materials with holes.
#ifdef ALPHA_TEST
#include "lib/alpha.glsl"
#include "lib/triangle_point.glsl"
#endif

flat in uint triangle;
layout(location = 0) out uint visible;

void main() {
#ifdef ALPHA_TEST
  // At the point that the G-buffer will store, not at the rasterizer's interpolation.
  if (cutAway(triangle, pointOnTriangle(triangle, frame.eye, pixelRay(ivec2(gl_FragCoord.xy))).barycentrics)) discard;
#endif
  visible = triangle + 1u;
}
