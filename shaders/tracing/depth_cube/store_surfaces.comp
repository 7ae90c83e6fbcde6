// What hits are shaded with: normal, base color and reflectivity of every sample, once it is known which are kept.
// One invocation per texel, which ends with its last sample: a software rasterizer skips nothing else.
#include "lib/triangles.glsl"
#include "shared/passes/depth_cube.h"
#include "tracing/common/projections.glsl"
#include "tracing/common/stored_surface.glsl"
#include "tracing/depth_cube/cube.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = UNIT_CUBE_DEPTHS) uniform sampler2DArray cubeDepths;
layout(binding = UNIT_CUBE_TRIANGLES) uniform usampler2DArray cubeTriangles;
layout(r32ui, binding = IMAGE_CUBE_NORMALS) writeonly uniform uimage2DArray normals;
layout(rgba8, binding = IMAGE_CUBE_COLORS) writeonly uniform image2DArray colors;
uniform int layerCount;
uniform float texelSize;  // meters

// Of the texel's center.
vec2 barycentricsAt(uint triangle, ivec2 place) {
  vec3 a, b, c;
  trianglePositions(triangle, a, b, c);
  int axis = axisOfTexel(place);
  ProjectedTriangle t = projectAlong(a, b, c, axis);
  vec2 ab = t.b.xy - t.a.xy, ac = t.c.xy - t.a.xy;
  vec2 at = (vec2(place - cubeTexel(axis, ivec2(0))) + 0.5) / float(bufferResolution) - t.a.xy;
  float area = ab.x * ac.y - ab.y * ac.x;
  vec2 weights = vec2(at.x * ac.y - at.y * ac.x, ab.x * at.y - ab.y * at.x);
  return area == 0.0 ? vec2(0.0) : clamp(weights / area, 0.0, 1.0);
}

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (texel.x >= 3 * bufferResolution || texel.y >= bufferResolution) return;
  for (ivec3 place = ivec3(texel, 0); place.z < layerCount; ++place.z) {
    if (texelFetch(cubeDepths, place, 0).x >= CUBE_NO_SAMPLE) break;
    uint triangle = texelFetch(cubeTriangles, place, 0).x;
    StoredSurface surface = evaluateStoredSurface(triangle, barycentricsAt(triangle, texel), texelSize);
    imageStore(normals, place, uvec4(packUnit(surface.normal)));
    imageStore(colors, place, sqrt(clamp(vec4(surface.baseColor, surface.reflectivity), 0.0, 1.0)));
  }
}
