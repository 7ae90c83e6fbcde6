// Search in a voxel for the identity method: every triangle of the texels that the ray crosses is tested exactly; the
// nearest hit wins, equal distances go to the lower number, so the order of a list has no say.
#include "tracing/identity_entry.glsl"
#include "tracing/ray_triangle.glsl"

layout(std430, binding = SSBO_ENTRIES) readonly buffer EntryBlock { uvec2 entries[]; };

void testCandidate(TraceRay ray, uint triangle, inout Hit best) {
  vec3 a, b, c;
  trianglePositions(triangle, a, b, c);
  vec3 tuv;
  bool back;
  bool met = intersectTriangle(ray.shear, ray.origin, a, b, c, tuv, back);
  bool nearer = tuv.x >= ray.least && (tuv.x < best.t || (tuv.x == best.t && triangle < best.triangle));
  when (met && nearer) {
    uint material = triangleAt(triangle).w;
    bool visible = !back || doubleSided(material);
    when (visible && (materials[material].flags & MATERIAL_CUT) != 0u) visible = !cutAway(triangle, tuv.yz);
    if (visible) best = Hit(tuv.x, triangle, tuv.y, tuv.z);
  }
}

// Looks at what the A-buffer of `axis` holds along the ray from `begin` to `end`. `best.t` starts at a large number.
void searchBuffer(TraceRay ray, int axis, float begin, float end, inout Hit best, inout int work) {
  TexelWalk walk = startTexelWalk(ray, axis, begin);
  float enter = begin;
  bool going = true;
  while (going) {
    float leave = min(walkExit(walk), end);
    vec2 depths = vec2(walk.depth + walk.depthStep * enter, walk.depth + walk.depthStep * leave);
    depths = vec2(min(depths.x, depths.y) - depthSlack, max(depths.x, depths.y) + depthSlack);
    int slab = slabOf(depths.x), lastSlab = slabOf(depths.y);
    while (slab <= lastSlab) {
      PageCursor it = firstEntry(heads[headIndex(axis, slab, walk.texel)]);
      while (it.entry != noCursor) {
        uvec2 entry = entries[it.entry];
        vec2 range = identityDepths(entry);
        when (range.x <= depths.y && range.y >= depths.x && entry.x != ray.excluded)
          testCandidate(ray, entry.x, best);
        nextEntry(it);
        ++work;
      }
      if (it.entry != noCursor) cut = true;
      ++slab;
    }
    if (slab <= lastSlab) cut = true;
    ++work;
    enter = leave;
    // A hit behind this texel may still be beaten by a triangle of the texels before it.
    going = !cut && leave < end && best.t > leave && stepTexelWalk(walk);
  }
  if (going) cut = true;
}

// True when the ray's nearest hit is known: it lies before `end`.
bool searchVoxel(TraceRay ray, uint mask, float begin, float end, inout Hit best, inout int work) {
  for (uint left = mask; left != 0u; left &= left - 1u) searchBuffer(ray, findLSB(left), begin, end, best, work);
  return best.t <= end;
}

void storeSurface(uint index, Hit hit) {}
