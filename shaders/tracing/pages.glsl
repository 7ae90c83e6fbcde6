// The paged A-buffer: lists of pages a texel (Crassin 2010; Kastrati & Goswami 2017, section 3.2.1), without a lock.
// Page number and fill of the first page share one word that is changed by compare-and-swap; further pages are full.
// PAGE_SIZE is a define; 1 makes it a plain linked list. PAGE_WRITE needs counters.glsl.
#include "shared/tracing.h"

layout(std430, binding = SSBO_HEADS) PAGE_ACCESS buffer HeadBlock { uint heads[]; };
layout(std430, binding = SSBO_LINKS) PAGE_ACCESS buffer LinkBlock { uint links[]; };  // a page: the next page + 1

#ifdef PAGE_WRITE
uniform uint pageCapacity;

const uint noEntry = 0xffffffffu;
// More failed swaps than there can be rivals for one texel at a time.
const int maxAttempts = 4096;

// A free page + 1, or 0 where the pool is exhausted.
uint takePage() {
  uint spare = atomicExchange(counters[COUNTER_SPARE], 0u);
  if (spare != 0u) return spare;
  uint page = atomicAdd(counters[COUNTER_PAGES], 1u);
  return page < pageCapacity ? page + 1u : 0u;
}

uint firstPage(uint head) { return (head & ~HEAD_INCOMPLETE) >> PAGE_FILL_BITS; }

// Index of a new entry of the texel's list, or noEntry where the pool is full: the texel is then marked and counted.
uint reserveEntry(uint headSlot) {
  uint head = heads[headSlot];
  uint page = 0u;
  for (int attempt = 0; attempt < maxAttempts; ++attempt) {
    uint fill = head & PAGE_FILL_MASK;
    bool room = firstPage(head) != 0u && fill < PAGE_SIZE;
    if (!room && page == 0u) {
      page = takePage();
      if (page == 0u) break;
    }
    if (!room) links[page - 1u] = firstPage(head);
    uint wanted = room ? head + 1u : (head & HEAD_INCOMPLETE) | (page << PAGE_FILL_BITS) | 1u;
    uint seen = atomicCompSwap(heads[headSlot], head, wanted);
    if (seen == head) {
      // A rival has linked a page meanwhile: ours goes to the next taker.
      if (room && page != 0u) atomicExchange(counters[COUNTER_SPARE], page);
      return room ? (firstPage(head) - 1u) * PAGE_SIZE + fill : (page - 1u) * PAGE_SIZE;
    }
    head = seen;
  }
  if (page != 0u) atomicExchange(counters[COUNTER_SPARE], page);
  atomicOr(heads[headSlot], HEAD_INCOMPLETE);
  countAt(COUNTER_LOST, ivec2(headSlot, headSlot >> 3));
  return noEntry;
}
#else
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
#endif
