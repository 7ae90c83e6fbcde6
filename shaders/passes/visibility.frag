// Which triangle a pixel sees. Compiled with ALPHA_TEST for materials with holes.
#ifdef ALPHA_TEST
#include "lib/alpha.glsl"
#include "lib/triangle_point.glsl"
#endif

flat in uint triangle;
layout(location = 0) out uint visible;

void main() {
#ifdef ALPHA_TEST
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  // At the point that the G-buffer will store, not at the rasterizer's interpolation.
  if (cutAway(triangle, pointOnTriangle(triangle, pixelOrigin(pixel), pixelRay(pixel)).barycentrics)) discard;
#endif
  visible = triangle + 1u;
}
