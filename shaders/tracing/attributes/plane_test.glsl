// search.test=plane: a point lies inside an object if it is behind the plane of the fragment that is nearest to it in
// depth. So a surface is known between its texels, and sheets and open objects have sides, too.
#include "tracing/attributes/fragments.glsl"
#include "tracing/common/ray_work.glsl"
#include "tracing/common/trace_state.glsl"

// What a point of the ray sees in its texel, among the fragments that count for this voxel and ray.
struct Sample {
  float t;
  float depth;            // the point's
  float side;             // meters, < 0: the point lies behind the nearest fragment's surface; 0: no fragment
  ivec2 texel;
  uint nearest;           // fragment nearest in depth, or noFragment
  float nearestDepth;
  float nearestTriangle;  // ties go to the lower number: the order of a list is the GPU's choice
};

// The triangle's number alone does not keep a ray off the surface that it leaves: on a curved one some neighbors'
// depths lie in front of the ray. Near its origin it therefore does not see surfaces that face along it, as those of
// the surface that it leaves do.
bool counts(TraceRay ray, vec3 normal, uint triangle, float t) {
  return triangle != ray.excluded && (!near(t, 4.0) || dot(normal, ray.direction) <= 0.0);
}

// Distance (meters) of a point of the ray from the plane of a fragment, which lies in its texel's center.
float planeSide(TraceRay ray, int axis, float t, ivec2 texel, float depth, vec3 normal) {
  vec3 at = vec3((vec2(texel) + 0.5) / float(bufferResolution), depth);
  return dot(normal / gridInverse, ray.gridOrigin + ray.gridDirection * t - unpermute(at, axis));
}

Sample sampleAt(TraceRay ray, Slab slab, float t, ivec2 texel, inout int work) {
  countTest();
  Sample s = Sample(t, permute(ray.gridOrigin + ray.gridDirection * t, slab.axis).z, 0.0, texel, noFragment, 0.0, 0.0);
  PageCursor it = firstEntry(heads[headIndex(slab.axis, texel)]);
  bool going = it.entry != noCursor;
  while (going) {
    float depth = imageLoad(pool, int(it.entry) * ENTRY_TEXELS).w;
    if (depth >= slab.depths.x && depth <= slab.depths.y) {
      vec4 stored = imageLoad(pool, int(it.entry) * ENTRY_TEXELS + 1);
      vec3 normal = unpackNormalReflectivity(stored).xyz;
      float away = abs(depth - s.depth), known = abs(s.nearestDepth - s.depth);
      bool nearer = s.nearest == noFragment || away < known || (away == known && stored.w < s.nearestTriangle);
      if (nearer && counts(ray, normal, uint(stored.w), t)) {
        s.nearest = it.entry;
        s.nearestDepth = depth;
        s.nearestTriangle = stored.w;
        s.side = planeSide(ray, slab.axis, t, texel, depth, normal);
      }
    }
    nextEntry(it);
    ++work;
    going = it.entry != noCursor;
#ifdef SORTED
    if (depth > slab.depths.y) going = false;
#endif
  }
  if (going) cut = true;
  return s;
}

bool sheet(Sample s) { return doubleSided(triangleAt(uint(s.nearestTriangle)).w); }

// Into a solid the ray goes through a surface that faces it; the backs of single-sided surfaces are invisible.
bool facing(TraceRay ray, Sample s) { return dot(normalOf(s.nearest), ray.direction) < 0.0; }

// Whether the ray meets a surface between two neighboring points. It goes into a solid if the second point is
// inside, whether or not the wall that it passes left a fragment in this A-buffer: steep walls leave none. A sheet of
// two sides has no inside: if the first point does not know it, or may know the surface that the ray leaves, that
// must lie before the plane of what the second sees, or within half a texel of it: planes are known no better. A sheet
// is met from behind too.
bool crossed(TraceRay ray, int axis, Sample a, Sample b) {
  if (a.side >= 0.0 && b.side < 0.0) {
    if (!sheet(b)) return facing(ray, b);
    if (a.nearest != noFragment && !near(a.t, 1.0)) return true;
    float halfTexel = 0.5 / (float(bufferResolution) * max(gridInverse.x, max(gridInverse.y, gridInverse.z)));
    return planeSide(ray, axis, a.t, b.texel, b.nearestDepth, normalOf(b.nearest)) >= -halfTexel;
  }
  return a.side < 0.0 && b.side > 0.0 && sheet(b) && !facing(ray, a) && !facing(ray, b);
}

// Whether the ray is inside where it comes into a voxel: a wall between two voxels may have left fragments in neither.
bool startsInside(TraceRay ray, Sample s) {
  return s.side < 0.0 && s.t > ray.least && !sheet(s) && facing(ray, s);
}

// Where between two points the surface lies, and its fragment: what is left of the stretch is cut by the plane of the
// fragment behind.
float settle(TraceRay ray, int axis, Sample a, Sample b, out uint fragment) {
  fragment = b.nearest != noFragment ? b.nearest : a.nearest;
  if (b.nearest == noFragment) return b.t;
  float before = planeSide(ray, axis, a.t, b.texel, b.nearestDepth, normalOf(b.nearest));
  return before * b.side < 0.0 ? a.t + (b.t - a.t) * before / (before - b.side) : b.t;
}
