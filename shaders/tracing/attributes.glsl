// Search in a voxel for the methods that store attributes (Hu et al. 2014, section 3.2): linear search for the first
// point of the ray that lies inside an object, by the depths of the fragments in each point's texel, then binary search
// back to where the ray went in. LINEAR_STEPS > 0 takes that many equal steps; 0 visits every texel (full 2D-DDA).
#define PAGE_ACCESS readonly
#include "tracing/pages.glsl"
#define POOL_ACCESS readonly
#include "tracing/attributes_entry.glsl"

layout(std430, binding = SSBO_HIT_SURFACES) writeonly buffer HitSurfaceBlock { HitSurface hitSurfaces[]; };
uniform int refinements;

const uint noFragment = 0xffffffffu;
uint foundFragment = noFragment;

// What a point of the ray sees in its texel, among the fragments that count for this voxel and ray.
struct Sample {
  float t;
  float depth;            // the point's
  float side;             // metres, < 0: the point lies behind the nearest fragment's surface; 0: no fragment
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

// The triangle's number alone does not keep a ray off the surface that it leaves: on a curved one some neighbours'
// depths lie in front of the ray. Near its origin it therefore does not see surfaces that face along it, as those of
// the surface that it leaves do.
bool counts(TraceRay ray, vec3 normal, uint triangle, float t) {
  return triangle != ray.excluded && (!near(t, 4.0) || dot(normal, ray.direction) <= 0.0);
}

// Distance (metres) of a point of the ray from the plane of a fragment, which lies in its texel's centre.
float planeSide(TraceRay ray, int axis, float t, ivec2 texel, float depth, vec3 normal) {
  vec3 at = vec3((vec2(texel) + 0.5) / float(bufferResolution), depth);
  return dot(normal / gridInverse, ray.gridOrigin + ray.gridDirection * t - unpermute(at, axis));
}

Sample sampleAt(TraceRay ray, Slab slab, float t, ivec2 texel, inout int work) {
  Sample s = Sample(t, permute(ray.gridOrigin + ray.gridDirection * t, slab.axis).z, 0.0, texel, noFragment, 0.0, 0.0);
  PageCursor it = firstEntry(heads[headIndex(slab.axis, texel)]);
  bool going = it.entry != noCursor;
  while (going) {
    float depth = imageLoad(pool, int(it.entry) * ENTRY_TEXELS).w;
    when (depth >= slab.depths.x && depth <= slab.depths.y) {
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

// Whether the ray meets a surface between two neighbouring points. Into a solid it goes where the second point is
// inside, whether or not the wall that it passes left a fragment in this A-buffer: steep walls leave none. A sheet of
// two sides has no inside: where the first point does not know it, or may know the surface that the ray leaves, that
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

// Narrows a crossing down; keeps it where it beats `best`.
void refine(TraceRay ray, Slab slab, Sample a, Sample b, inout Hit best, inout int work) {
  for (int i = 0; i < refinements; ++i) {
    float t = 0.5 * (a.t + b.t);
    Sample middle = sampleAt(ray, slab, t, texelAt(ray, slab.axis, t), work);
    if (crossed(ray, slab.axis, a, middle))
      b = middle;
    else
      a = middle;
  }
  // What is left of the stretch is cut by the plane of the fragment behind.
  float t = b.t;
  if (b.nearest != noFragment) {
    float before = planeSide(ray, slab.axis, a.t, b.texel, b.nearestDepth, normalOf(b.nearest));
    if (before * b.side < 0.0) t = a.t + (b.t - a.t) * before / (before - b.side);
  }
  uint fragment = b.nearest != noFragment ? b.nearest : a.nearest;
  if (fragment == noFragment || t < ray.least || t >= best.t) return;
  best = Hit(t, uint(imageLoad(pool, int(fragment) * ENTRY_TEXELS + 1).w), 0.0, 0.0);
  foundFragment = fragment;
}

void searchBuffer(TraceRay ray, int axis, float begin, float end, inout Hit best, inout int work) {
  vec2 depths = vec2(permute(ray.gridOrigin + ray.gridDirection * begin, axis).z,
                     permute(ray.gridOrigin + ray.gridDirection * end, axis).z);
  // The voxel's own range, and a texel more: a surface's fragment may lie just across the border.
  float layers = float(voxelCount[axis]);
  float layer = floor(0.5 * (depths.x + depths.y) * layers);
  Slab slab = Slab(axis, vec2(layer, layer + 1.0) / layers + vec2(-1.0, 1.0) / float(bufferResolution));

  float known = best.t;
  Sample last = sampleAt(ray, slab, begin, texelAt(ray, axis, begin), work);
  // A wall between two voxels may have left fragments in neither: the ray then starts inside.
  if (last.side < 0.0 && begin > ray.least && !sheet(last) && facing(ray, last)) {
    best = Hit(begin, uint(last.nearestTriangle), 0.0, 0.0);
    foundFragment = last.nearest;
    return;
  }
#if LINEAR_STEPS > 0
  for (int i = 1; i <= LINEAR_STEPS; ++i) {
    float t = begin + (end - begin) * float(i) / float(LINEAR_STEPS);
    Sample next = sampleAt(ray, slab, t, texelAt(ray, axis, t), work);
    when (crossed(ray, slab.axis, last, next)) refine(ray, slab, last, next, best, work);
    if (best.t < known) break;
    last = next;
  }
#else
  TexelWalk walk = startTexelWalk(ray, axis, begin);
  float enter = begin;
  bool going = true;
  while (going) {
    float leave = min(walkExit(walk), end);
    // The middle of the texel's stretch; in the last texel its end, so that the whole stretch is looked at.
    float t = leave < end ? 0.5 * (enter + leave) : end;
    Sample next = sampleAt(ray, slab, max(t, last.t), walk.texel, work);
    when (crossed(ray, slab.axis, last, next)) refine(ray, slab, last, next, best, work);
    last = next;
    enter = leave;
    going = !cut && best.t >= known && leave < end && stepTexelWalk(walk);
  }
  if (going) cut = true;
#endif
}

// From voxel to voxel until one answers: one surface a voxel is the methods' assumption, and the first one found ends
// the search. False if the ray is not through; `pause` then says how to go on.
bool march(TraceRay ray, float end, inout PausedRay pause, inout Hit best) {
  incomplete = pause.incomplete != 0u;
  float t = pause.t;
  int work = 0;
  bool yielded = false;
  bool going = t < end;
  VoxelWalk walk = startVoxelWalk(ray, t);
  while (going) {
    float leave = max(t, min(voxelExit(walk), end));
    for (uint mask = voxelMask(walk.voxel); mask != 0u; mask &= mask - 1u)
      searchBuffer(ray, findLSB(mask), t, leave, best, work);
    going = best.t == farAway && !cut && leave < end && stepVoxelWalk(ray, walk);
    if (going) {
      t = leave;
      yielded = ++work >= workLimit;
      going = !yielded;
    }
  }
  pause.t = t;
  pause.incomplete = incomplete ? 1u : 0u;
  return !(cut || yielded || going);
}

void storeSurface(uint index, Hit hit) {
  HitSurface surface = HitSurface(vec3(0.0), 0.0, vec3(0.0), 0.0);
  if (hit.t >= 0.0) {
    surface.baseColor = imageLoad(pool, int(foundFragment) * ENTRY_TEXELS).xyz;
    vec4 stored = unpackNormalReflectivity(imageLoad(pool, int(foundFragment) * ENTRY_TEXELS + 1));
    surface.normal = stored.xyz;
    surface.reflectivity = stored.w;
  }
  hitSurfaces[index] = surface;
}
