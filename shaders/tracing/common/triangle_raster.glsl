// Vertex side of rasterizing the scene along an axis (vertex pulling, no vertex attributes).
//
// Instance i is the projection along axis i, or that along the triangle's own dominant axis. Plain rasterization draws
// the projected corners. Conservative rasterization draws six vertices per triangle, a rectangle along its longest edge
// in the projection, grown by half a texel's diagonal. It covers every texel that the triangle touches, whatever the
// triangle's shape (no acute corners to blow up, unlike shifted edges, Hasselgren et al. 2005); the fragment shader
// rejects what it covers in excess.
#include "lib/triangles.glsl"
#include "tracing/common/grid.glsl"
#include "tracing/common/projections.glsl"

uniform int rasterResolution;  // texels along each side of the raster; conservative: the grid's longest side

// Half a texel's diagonal, and room for the rasterizer's snapping of vertices.
const float conservativeMargin = 0.7072 + 0.05;

ProjectedTriangle projectTriangle(uint triangle, int instance) {
  vec3 a, b, c;
  trianglePositions(triangle, a, b, c);
  return projectTriangle(a, b, c, instance);
}

// Corner 0..5 of the two triangles that cover the projection, in clip space.
vec4 coveringCorner(ProjectedTriangle t, int corner) {
  vec2 scale = vec2(permutedVoxels(t.axis).xy);
  vec2 p[3] = vec2[3](t.a.xy * scale, t.b.xy * scale, t.c.xy * scale);
  vec2 edges[3] = vec2[3](p[1] - p[0], p[2] - p[1], p[0] - p[2]);
  vec2 along = edges[0];
  if (dot(edges[1], edges[1]) > dot(along, along)) along = edges[1];
  if (dot(edges[2], edges[2]) > dot(along, along)) along = edges[2];
  float size = length(along);
  along = size > 0.0 ? along / size : vec2(1.0, 0.0);
  vec2 across = vec2(-along.y, along.x);
  // Relative to the first vertex, so that large coordinates cost no precision.
  vec2 low = vec2(0.0), high = vec2(0.0);
  for (int i = 1; i < 3; ++i) {
    vec2 q = vec2(dot(p[i] - p[0], along), dot(p[i] - p[0], across));
    low = min(low, q);
    high = max(high, q);
  }
  low -= conservativeMargin;
  high += conservativeMargin;
  bool right = corner == 1 || corner == 2 || corner == 4;
  bool top = corner == 2 || corner == 4 || corner == 5;
  vec2 q = vec2(right ? high.x : low.x, top ? high.y : low.y);
  vec2 position = p[0] + q.x * along + q.y * across;
  return vec4(position / float(rasterResolution) * 2.0 - 1.0, 0.0, 1.0);
}
