// Where the surface of a pixel is, from the triangle that it shows.
#include "lib/gbuffer.glsl"
#include "lib/triangle_point.glsl"

// The point on the pixel's ray, and its meters along the view axis; 0 if there is no surface.
vec4 surfacePoint(ivec2 pixel) {
  uint visible = texelFetch(gVisibility, pixel, 0).x;
  if (visible == 0u) return vec4(0.0);
  TrianglePoint point = pointOnTriangle(visible - 1u, pixelOrigin(pixel), pixelRay(pixel));
  precise float along = dot(point.relative, frame.forward);
  return vec4(point.position, along);
}
