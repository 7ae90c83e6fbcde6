// The paged A-buffer: lists of pages per texel (Crassin 2010; Kastrati & Goswami 2017, section 3.2.1), without a lock.
// Page number and fill of the first page share one word that is changed by compare-and-swap; further pages are full.
// PAGE_SIZE is a define; 1 makes it a plain linked list. Programs that write define PAGE_ACCESS before anything else.
#include "shared/passes/attributes.h"

#ifndef PAGE_ACCESS
#define PAGE_ACCESS readonly
#endif
layout(std430, binding = SSBO_HEADS) PAGE_ACCESS buffer HeadBlock { uint heads[]; };
layout(std430, binding = SSBO_LINKS) PAGE_ACCESS buffer LinkBlock { uint links[]; };  // per page: the next page + 1
