// The faces of the cube: along x, y, z, then -x, -y, -z. A face's picture has the axis after its own to the right and
// the next one up, and sees 90 degrees.
#include "shared/passes/captures.h"

layout(std140, binding = UBO_PROBE) uniform ProbeBlock { vec4 probe; };  // w: nearer surfaces are not captured, meters

// Right, up and along the face's way.
vec3 toFace(vec3 v, int face) {
  vec3 p = face % 3 == 0 ? v.yzx : (face % 3 == 1 ? v.zxy : v.xyz);
  return face < 3 ? p : vec3(p.xy, -p.z);
}

vec3 fromFace(vec3 p, int face) {
  vec3 q = face < 3 ? p : vec3(p.xy, -p.z);
  return face % 3 == 0 ? q.zxy : (face % 3 == 1 ? q.yzx : q);
}

int faceOf(vec3 way) {
  vec3 size = abs(way);
  int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
  return way[axis] < 0.0 ? axis + 3 : axis;
}

// Through a texel's center, 1 along the face's way.
vec3 texelWay(ivec2 texel, int face, int resolution) {
  return fromFace(vec3(vec2(2 * texel + 1 - resolution) / float(resolution), 1.0), face);
}
