// search.test=depth (Hu et al. 2014, section 3.2): depths alone decide. A point lies inside an object if an odd number of
// its texel's fragments lies in front of it, and a surface between two points of which one does. That holds for closed
// objects that do not overlap; a ray inside one finds the way out the same way as one outside finds the way in.
#include "tracing/attributes/fragments.glsl"
#include "tracing/common/ray_work.glsl"
#include "tracing/common/trace_state.glsl"

struct Sample {
  float t;
  bool inside;            // of an object, or behind an odd number of open surfaces
  uint nearest;           // fragment nearest in depth, or noFragment
  float away;             // its distance in depth
  float nearestTriangle;  // ties go to the lower number: the order of a list is the GPU's choice
};

Sample sampleAt(TraceRay ray, Slab slab, float t, ivec2 texel, inout int work) {
  countTest();
  float depth = permute(ray.gridOrigin + ray.gridDirection * t, slab.axis).z;
  Sample s = Sample(t, false, noFragment, farAway, 0.0);
  PageCursor it = firstEntry(heads[headIndex(slab.axis, texel)]);
  bool going = it.entry != noCursor;
  while (going) {
    float stored = imageLoad(pool, int(it.entry) * ENTRY_TEXELS).w;
    if (stored < depth) s.inside = !s.inside;
    float away = abs(stored - depth);
    float triangle = imageLoad(pool, int(it.entry) * ENTRY_TEXELS + 1).w;
    if (away < s.away || (away == s.away && triangle < s.nearestTriangle)) {
      s.nearest = it.entry;
      s.away = away;
      s.nearestTriangle = triangle;
    }
    nextEntry(it);
    ++work;
    going = it.entry != noCursor;
#ifdef SORTED
    if (stored > depth) going = false;
#endif
  }
  if (going) cut = true;
  return s;
}

// A change in either direction: a ray outside looks for the first point inside, one inside (refraction) for the first
// point outside.
bool crossed(TraceRay ray, int axis, Sample a, Sample b) { return a.inside != b.inside; }

// Where open surfaces are, a side means nothing but in comparison.
bool startsInside(TraceRay ray, Sample s) { return false; }

// Whether a surface may be the one that the ray leaves: near the origin those that face it as that one does. A reflected
// ray leaves what faces along it, a refracted one on its way in what faces it.
bool isLeft(TraceRay ray, vec3 normal, uint triangle, float t) {
  if (triangle == ray.excluded) return true;
  if (!near(t, 4.0) || ray.excluded == NO_TRIANGLE) return false;
  vec3 a, b, c;
  trianglePositions(ray.excluded, a, b, c);
  return dot(normal, ray.direction) * dot(cross(b - a, c - a), ray.direction) > 0.0;
}

// Where between two points the surface lies, and its fragment: that of either point which is nearer in depth. None if
// the ray does not hit it: backs of single-sided surfaces are invisible.
float settle(TraceRay ray, int axis, Sample a, Sample b, out uint fragment) {
  float t = 0.5 * (a.t + b.t);
  fragment = a.away < b.away ? a.nearest : b.nearest;
  if (fragment != noFragment) {
    uint triangle = triangleOf(fragment);
    vec3 normal = normalOf(fragment);
    bool visible = dot(normal, ray.direction) < 0.0 || doubleSided(triangleAt(triangle).w);
    if (!visible || isLeft(ray, normal, triangle, t)) fragment = noFragment;
  }
  return t;
}
