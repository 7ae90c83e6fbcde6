// Watertight ray/triangle test (Woop, Benthin & Wald 2013): the triangle is sheared into the ray's frame, where the
// sign of an edge function is the same for both triangles of a shared edge, whatever the rounding. `precise` keeps the
// compiler from fusing the two products of an edge function, which would break that symmetry.
#include "lib/when.glsl"

struct RayShear {
  int axis;      // of the direction's largest component
  bool flipped;  // the other two are exchanged to keep the winding
  vec3 scale;    // shear x, shear y, 1 / direction along the axis
};

vec3 toShearAxes(vec3 v, RayShear shear) {
  vec3 p = shear.axis == 0 ? v.yzx : (shear.axis == 1 ? v.zxy : v.xyz);
  return shear.flipped ? p.yxz : p;
}

RayShear makeShear(vec3 direction) {
  vec3 size = abs(direction);
  RayShear shear;
  shear.axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
  shear.flipped = direction[shear.axis] < 0.0;
  vec3 d = toShearAxes(direction, shear);
  shear.scale = vec3(d.x / d.z, d.y / d.z, 1.0 / d.z);
  return shear;
}

// tuv: distance in units of the direction's length, barycentric weights of b and c. back: seen from behind.
bool intersectTriangle(RayShear shear, vec3 origin, vec3 a, vec3 b, vec3 c, out vec3 tuv, out bool back) {
  precise vec3 pa = toShearAxes(a - origin, shear);
  precise vec3 pb = toShearAxes(b - origin, shear);
  precise vec3 pc = toShearAxes(c - origin, shear);
  precise vec2 qa = pa.xy - shear.scale.xy * pa.z;
  precise vec2 qb = pb.xy - shear.scale.xy * pb.z;
  precise vec2 qc = pc.xy - shear.scale.xy * pc.z;
  precise float u = qc.x * qb.y - qc.y * qb.x;
  precise float v = qa.x * qc.y - qa.y * qc.x;
  precise float w = qb.x * qa.y - qb.y * qa.x;
  when (u == 0.0 || v == 0.0 || w == 0.0) {
    // On an edge within float: decide in double, as both neighbors will.
    u = float(double(qc.x) * double(qb.y) - double(qc.y) * double(qb.x));
    v = float(double(qa.x) * double(qc.y) - double(qa.y) * double(qc.x));
    w = float(double(qb.x) * double(qa.y) - double(qb.y) * double(qa.x));
  }
  tuv = vec3(0.0);
  back = false;
  if ((u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0)) return false;
  precise float determinant = u + v + w;
  if (determinant == 0.0) return false;
  precise float t = (u * pa.z + v * pb.z + w * pc.z) * shear.scale.z;
  tuv = vec3(t, v, w) / determinant;
  back = determinant < 0.0;
  return true;
}
