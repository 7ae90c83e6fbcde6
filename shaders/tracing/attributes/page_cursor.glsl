// Reads a texel's list.
#include "tracing/attributes/pages.glsl"
#include "tracing/common/trace_state.glsl"

// for (PageCursor it = firstEntry(head); it.entry != noCursor; nextEntry(it)) visits a texel's entries.
const uint noCursor = 0xffffffffu;
struct PageCursor {
  uint entry;
  uint page;  // number + 1
  uint left;  // entries of this page after `entry`
};

PageCursor firstEntry(uint head) {
  uint page = (head & ~HEAD_INCOMPLETE) >> PAGE_FILL_BITS;
  uint fill = head & PAGE_FILL_MASK;
  if ((head & HEAD_INCOMPLETE) != 0u) incomplete = true;
  return PageCursor(page == 0u ? noCursor : (page - 1u) * PAGE_SIZE + fill - 1u, page, fill - 1u);
}

void nextEntry(inout PageCursor it) {
  if (it.left > 0u) {
    --it.left;
    --it.entry;
    return;
  }
  it.page = links[it.page - 1u];
  it.left = PAGE_SIZE - 1u;
  it.entry = it.page == 0u ? noCursor : it.page * PAGE_SIZE - 1u;
}
