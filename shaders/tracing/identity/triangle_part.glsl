// Bounds of a triangle's part in a voxel, from above: of its edges between the voxel's faces, and of its plane. All in
// voxels, from the voxel's lowest corner.
#include "lib/triangles.glsl"
#include "tracing/common/grid.glsl"
#include "tracing/identity/entry.glsl"

const float partSlack = 0.02;       // of the voxel that parts are taken in; fragments reach less beyond it
const float positionError = 1e-4;   // more than a coordinate can be off by rounding

// Adds the stretch of an edge between the faces across an axis.
void addStretch(vec3 from, vec3 to, int axis, inout vec3 low, inout vec3 high) {
  float along = to[axis] - from[axis];
  float below = -partSlack - from[axis], above = 1.0 + partSlack - from[axis];
  vec2 range = vec2(0.0, 1.0);
  if (abs(along) > positionError) {
    float t0 = below / along, t1 = above / along;
    range = vec2(max(0.0, min(t0, t1)), min(1.0, max(t0, t1)));
  } else if (below > 0.0 || above < 0.0) {
    return;
  }
  if (range.x > range.y) return;
  vec3 p = mix(from, to, range.x), q = mix(from, to, range.y);
  low = min(low, min(p, q));
  high = max(high, max(p, q));
}

uint partInVoxel(uint triangle, ivec3 voxel) {
  vec3 a, b, c, corner = vec3(voxel);
  trianglePositions(triangle, a, b, c);
  a = toGrid(a) * vec3(voxelCount) - corner;
  b = toGrid(b) * vec3(voxelCount) - corner;
  c = toGrid(c) * vec3(voxelCount) - corner;
  vec3 low = max(min(a, min(b, c)), vec3(-partSlack)), high = min(max(a, max(b, c)), vec3(1.0 + partSlack));
  for (int axis = 0; axis < 3; ++axis) {
    vec3 l = high, h = low;
    addStretch(a, b, axis, l, h);
    addStretch(b, c, axis, l, h);
    addStretch(c, a, axis, l, h);
    if (any(greaterThan(l, h))) continue;  // the triangle's inside alone comes between these faces
    low = max(low, l);
    high = min(high, h);
  }
  // The plane, over the box so far. What rounding does to the normal grows with the edges.
  vec3 ab = b - a, ac = c - a, normal = cross(ab, ac), size = max(abs(ab), abs(ac));
  float edge = max(size.x, max(size.y, size.z)), error = 12.0 * positionError * edge * (edge + 1.0);
  for (int k = 0; k < 3; ++k) {
    if (abs(normal[k]) <= error) continue;
    int i = (k + 1) % 3, j = (k + 2) % 3;
    vec3 middle = 0.5 * (low + high), half3 = 0.5 * (high - low);
    float center = a[k] - (normal[i] * (middle[i] - a[i]) + normal[j] * (middle[j] - a[j])) / normal[k];
    float spread = (abs(normal[i]) * half3[i] + abs(normal[j]) * half3[j] + error) / abs(normal[k]);
    low[k] = max(low[k], center - spread);
    high[k] = min(high[k], center + spread);
  }
  return boxBits(low, high);
}
