// What a point of a ray sees of the fragments in its texel, and whether there is a surface between two points.
#include "lib/scene.glsl"
#include "lib/triangles.glsl"
#include "tracing/attributes/entry.glsl"
#include "tracing/attributes/page_cursor.glsl"
#include "tracing/common/grid.glsl"
#include "tracing/common/ray_work.glsl"
#include "tracing/common/trace_state.glsl"
#include "tracing/common/walk.glsl"

const uint noFragment = 0xffffffffu;

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

struct Slab {
  int axis;
  vec2 depths;  // fragments outside do not count
};

// Near its origin a ray sees the surface that it leaves in other texels than its own, known by one depth each.
bool near(float t, float voxels) {
  vec3 voxelsPerMetre = vec3(voxelCount) * gridInverse;
  return t * max(voxelsPerMetre.x, max(voxelsPerMetre.y, voxelsPerMetre.z)) <= voxels;
}

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

ivec2 texelAt(TraceRay ray, int axis, float t) {
  vec2 p = permute(ray.gridOrigin + ray.gridDirection * t, axis).xy;
  return clamp(ivec2(floor(p * float(bufferResolution))), ivec2(0), ivec2(bufferResolution - 1));
}

bool sheet(Sample s) { return doubleSided(triangleAt(uint(s.nearestTriangle)).w); }

vec3 normalOf(uint fragment) {
  return unpackNormalReflectivity(imageLoad(pool, int(fragment) * ENTRY_TEXELS + 1)).xyz;
}

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
