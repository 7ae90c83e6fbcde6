// Bindings and constants of the attribute method: tracing/attributes/.
#ifndef HALFSILVER_PASSES_ATTRIBUTES_H
#define HALFSILVER_PASSES_ATTRIBUTES_H

#define SSBO_HEADS 12  // uint[3 * texels^2]: head words, below
#define SSBO_LINKS 13  // uint[pages]: the next page + 1

#define IMAGE_ENTRIES 0  // texels of entries

// A head word is 0 for an empty texel, else (page + 1) << PAGE_FILL_BITS | entries in that page. HEAD_INCOMPLETE is set
// if the pool had no room for a fragment: a ray that comes by is an overflow, not a miss.
// Linked lists are pages of one entry: their shaders define one bit for the fill and so can number more pages.
#ifndef PAGE_FILL_BITS
#define PAGE_FILL_BITS 7
#endif
#define PAGE_FILL_MASK ((1u << PAGE_FILL_BITS) - 1u)
#define HEAD_INCOMPLETE 0x80000000u
#define MAX_PAGES 0xfffffeu
#define MAX_LINKED_ENTRIES 0x3ffffffeu

#endif
