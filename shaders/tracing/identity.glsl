// Search of the identity method: every triangle of the voxels that the ray crosses is tested exactly; the nearest hit
// wins, equal distances go to the lower number, so the order of a list has no say.
//
// Lists are built on demand. A ray that comes to a voxel whose list is missing requests it, and those of the next few
// voxels on its way, and waits for the next dispatch.
#include "tracing/voxel_lists.glsl"
#define REQUEST_ACCESS coherent
#include "tracing/requested_voxels.glsl"

layout(std430, binding = SSBO_ENTRIES) readonly buffer EntryBlock { uint entries[]; };  // triangle numbers
layout(std430, binding = SSBO_LIST_BUILD) coherent buffer ListBuildBlock { ListBuild listBuild; };
uniform int lookAhead;  // occupied voxels that a waiting ray requests

void testCandidate(TraceRay ray, uint triangle, inout Hit best) {
  vec3 a, b, c;
  trianglePositions(triangle, a, b, c);
  vec3 tuv;
  bool back;
  bool met = intersectTriangle(ray.shear, ray.origin, a, b, c, tuv, back);
  bool nearer = tuv.x >= ray.least && (tuv.x < best.t || (tuv.x == best.t && triangle < best.triangle));
  when (met && nearer && triangle != ray.excluded) {
    uint material = triangleAt(triangle).w;
    bool visible = !back || doubleSided(material);
    when (visible && (materials[material].flags & MATERIAL_CUT) != 0u) visible = !cutAway(triangle, tuv.yz);
    if (visible) best = Hit(tuv.x, triangle, tuv.y, tuv.z);
  }
}

// A list that is there has x <= y; one that is asked for or was never needed has no place yet.
bool present(uvec2 list) { return list.x < LIST_REQUESTED; }

void requestList(ivec3 voxel) {
  uint list = listOf(voxel);
  if (heads[list].x != LIST_MISSING) return;
  heads[list] = uvec2(LIST_REQUESTED, 0u);  // no entries counted yet; rivals write the same
  uint index = voxelIndex(voxel), bit = 1u << (index & 31u);
  if ((atomicOr(requestedWords[index >> 5], bit) & bit) == 0u) atomicAdd(listBuild.requested, 1u);
}

void requestAhead(TraceRay ray, VoxelWalk walk, float end) {
  int left = lookAhead;
  bool going = true;
  while (going) {
    if (voxelMask(walk.voxel) != 0u) {
      requestList(walk.voxel);
      --left;
    }
    going = left > 0 && voxelExit(walk) < end && stepVoxelWalk(ray, walk);
  }
}

// False where the ray is not through; `t` is then the voxel to go on with, and `left` the best triangle so far + 1 and
// the number of candidates that are done (exact to 2^24).
bool march(TraceRay ray, inout float t, float end, inout vec2 left, inout Hit best) {
  int work = 0;
  uint done = uint(left.y);
  if (left.x > 0.0) testCandidate(ray, uint(left.x) - 1u, best);
  bool yielded = false;
  uvec2 list = uvec2(0u);  // what is left of the voxel's candidates
  VoxelWalk walk = startVoxelWalk(ray, t);
  float leave = max(t, min(voxelExit(walk), end));
  bool going = t < end, entered = false;
  while (going) {
    // On to the next candidate. Walking and testing take turns, so that rays beside each other stay busy.
    while (going && list.x == list.y) {
      if (entered) {
        // A hit behind this voxel may still be beaten by a triangle of the voxels before it.
        going = best.t > leave && leave < end && stepVoxelWalk(ray, walk);
        if (going) {
          left = vec2(0.0);
          t = leave;
          leave = max(t, min(voxelExit(walk), end));
          yielded = ++work >= workLimit;
          going = !yielded;
        }
      }
      entered = true;
      if (going && voxelMask(walk.voxel) != 0u) {
        list = heads[listOf(walk.voxel)];
        when (!present(list)) {
          if (lastDispatch == 0) requestAhead(ray, walk, end);
          list = uvec2(0u);
          yielded = true;
          going = false;
        }
        list.x += going ? done : 0u;
        done = 0u;
      }
    }
    if (going && list.x != list.y) {
      testCandidate(ray, entries[list.x], best);
      ++list.x;
      if (++work >= workLimit && list.x != list.y) {
        // From the middle of the voxel's stretch the walk starts in this voxel again, but for the shortest ones, which
        // begin anew: there is no telling where rounding puts them.
        float middle = 0.5 * (t + leave);
        if (startVoxelWalk(ray, middle).voxel == walk.voxel) {
          t = middle;
          left = vec2(best.t < farAway ? float(best.triangle + 1u) : 0.0,
                      float(list.x - heads[listOf(walk.voxel)].x));
        }
        yielded = true;
        going = false;
      }
    }
  }
  return !(yielded || going);
}

void storeSurface(uint index, Hit hit) {}
