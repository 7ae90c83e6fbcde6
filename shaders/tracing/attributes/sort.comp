// Sorts each texel's linked list by depth, then triangle (Hu et al. 2014, section 3.1): one level of a bottom-up merge
// sort per dispatch, runs of `runLength` merged in pairs by relinking. One invocation per texel; pages hold one entry.
#define PAGE_ACCESS
#include "shared/tracing.h"
#include "tracing/attributes/entry.glsl"
#include "tracing/attributes/pages.glsl"
#include "tracing/common/counters.glsl"

layout(local_size_x = 64) in;

uniform uint headCount;
uniform uint runLength;

bool before(uint a, uint b) {
  float da = imageLoad(pool, int(a - 1u) * ENTRY_TEXELS).w, db = imageLoad(pool, int(b - 1u) * ENTRY_TEXELS).w;
  if (da != db) return da < db;
  return imageLoad(pool, int(a - 1u) * ENTRY_TEXELS + 1).w <= imageLoad(pool, int(b - 1u) * ENTRY_TEXELS + 1).w;
}

// First node after `count` nodes of a list (0: its end).
uint skip(uint node, uint count) {
  for (uint i = 0u; i < count && node != 0u; ++i) node = links[node - 1u];
  return node;
}

void main() {
  uint index = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  if (index >= headCount) return;
  uint head = (heads[index] & ~HEAD_INCOMPLETE) >> PAGE_FILL_BITS;
  if (head == 0u) return;
  uint left = head, first = 0u, tail = 0u;
  uint merges = 0u;
  bool cut = false;  // some drivers stop long loops (see trace_state.glsl)
  while (left != 0u) {
    uint right = skip(left, runLength), next = skip(right, runLength);
    uint leftLeft = runLength, rightLeft = runLength;
    uint a = left, b = right;
    if (b != 0u) ++merges;
    while ((a != 0u && leftLeft > 0u) || (b != 0u && rightLeft > 0u)) {
      bool aEnded = a == 0u || leftLeft == 0u, bEnded = b == 0u || rightLeft == 0u;
      bool takeA = bEnded || (!aEnded && before(a, b));
      uint node = takeA ? a : b;
      if (takeA) {
        a = links[a - 1u];
        --leftLeft;
      } else {
        b = links[b - 1u];
        --rightLeft;
      }
      if (tail == 0u)
        first = node;
      else
        links[tail - 1u] = node;
      tail = node;
    }
    cut = (a != 0u && leftLeft > 0u) || (b != 0u && rightLeft > 0u);
    left = next;
  }
  cut = cut || left != 0u;
  if (tail != 0u) links[tail - 1u] = 0u;
  // What a stopped merge has lost, rays must know of.
  uint incomplete = cut ? HEAD_INCOMPLETE : heads[index] & HEAD_INCOMPLETE;
  heads[index] = incomplete | (first << PAGE_FILL_BITS) | (first == 0u ? 0u : 1u);
  // The host goes on with longer runs while any list still had two to merge.
  if (merges > 0u) counters[COUNTER_UNSORTED] = 1u;
}
