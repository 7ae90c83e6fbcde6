// Takes room for a fragment in its texel's list.
#define PAGE_ACCESS coherent
#include "tracing/attributes/pages.glsl"
#include "tracing/common/counters.glsl"

uniform uint pageCapacity;

const uint noEntry = 0xffffffffu;
// More failed swaps than there can be rivals for one texel at a time.
const int maxAttempts = 4096;

// A free page + 1, or 0 if the pool is exhausted.
uint takePage() {
  uint spare = atomicExchange(counters[COUNTER_SPARE], 0u);
  if (spare != 0u) return spare;
  uint page = atomicAdd(counters[COUNTER_PAGES], 1u);
  return page < pageCapacity ? page + 1u : 0u;
}

uint firstPage(uint head) { return (head & ~HEAD_INCOMPLETE) >> PAGE_FILL_BITS; }

// Index of a new entry of the texel's list, or noEntry if the pool is full: the texel is then marked and counted.
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
