// Watertight ray/triangle test (Woop, Benthin & Wald 2013): the triangle is sheared into the ray's frame, where the
// sign of an edge function is the same for both triangles of a shared edge, whatever the rounding. `precise` keeps the
// compiler from fusing the two products of an edge function, which would break that symmetry.

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

// Where a ray passes a triangle, in the ray's frame: the corners across and along the ray, and the edge functions
// opposite to a, b and c.
struct EdgeTest {
  vec2 a, b, c;
  vec3 depths;
  vec3 edges;  // all of one sign, or zero, inside
};

EdgeTest testEdges(RayShear shear, vec3 origin, vec3 a, vec3 b, vec3 c) {
  precise vec3 pa = toShearAxes(a - origin, shear);
  precise vec3 pb = toShearAxes(b - origin, shear);
  precise vec3 pc = toShearAxes(c - origin, shear);
  precise vec2 qa = pa.xy - shear.scale.xy * pa.z;
  precise vec2 qb = pb.xy - shear.scale.xy * pb.z;
  precise vec2 qc = pc.xy - shear.scale.xy * pc.z;
  precise float u = qc.x * qb.y - qc.y * qb.x;
  precise float v = qa.x * qc.y - qa.y * qc.x;
  precise float w = qb.x * qa.y - qb.y * qa.x;
  return EdgeTest(qa, qb, qc, vec3(pa.z, pb.z, pc.z), vec3(u, v, w));
}

bool onEdge(EdgeTest test) { return any(equal(test.edges, vec3(0.0))); }

// The upper 12 of a float's 24 bits. Products of halves are exact.
float upperHalf(float value) { return uintBitsToFloat(floatBitsToUint(value) & 0xfffff000u); }

// a b - product, exactly, for the rounded product (after Dekker 1971). It takes floats alone: doubles are emulated on
// many devices, and fma() need not be fused.
float productError(float a, float b, float product) {
  precise float a1 = upperHalf(a), b1 = upperHalf(b), a0 = a - a1, b0 = b - b1;
  precise float error = a1 * b1 - product;
  error = error + a1 * b0;
  error = error + a0 * b1;
  error = error + a0 * b0;
  return error;
}

// a b - c d from the exact products: its sign is always right, and all but its last bit.
float exactDifference(float a, float b, float c, float d) {
  precise float p = a * b, q = c * d;
  precise float difference = p - q;
  precise float back = difference - p;
  precise float lost = (p - (difference - back)) - (q + back);
  precise float errors = productError(a, b, p) - productError(c, d, q);
  precise float rest = lost + errors;
  precise float sum = difference + rest;
  return sum;
}

// Decides what lies on an edge within float from the exact products, as both triangles of the edge will.
void decideEdges(inout EdgeTest test) {
  test.edges = vec3(exactDifference(test.c.x, test.b.y, test.c.y, test.b.x),
                    exactDifference(test.a.x, test.c.y, test.a.y, test.c.x),
                    exactDifference(test.b.x, test.a.y, test.b.y, test.a.x));
}

bool inside(EdgeTest test) {
  vec3 e = test.edges;
  return min(e.x, min(e.y, e.z)) >= 0.0 || max(e.x, max(e.y, e.z)) <= 0.0;
}

// Twice the area that the ray sees; negative from behind.
float determinantOf(EdgeTest test) {
  precise float sum = test.edges.x + test.edges.y + test.edges.z;
  return sum;
}

// In units of the direction's length.
float distanceOf(EdgeTest test, RayShear shear, float determinant) {
  precise float t = (test.edges.x * test.depths.x + test.edges.y * test.depths.y + test.edges.z * test.depths.z) *
                    shear.scale.z;
  precise float distance = t / determinant;
  return distance;
}
