#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include <halfsilver/model.h>

namespace halfsilver {

// Sorted, without empty ranges and overlaps.
std::vector<VertexRange> mergeRanges(std::span<const VertexRange> ranges);

// Whether merged ranges hold a vertex of first..last, inclusive.
inline bool touchesRange(std::span<const VertexRange> merged, std::uint32_t first, std::uint32_t last) {
  const auto range = std::partition_point(merged.begin(), merged.end(),
                                          [&](const VertexRange& each) { return each.first + each.count <= first; });
  return range != merged.end() && range->first <= last;
}

}  // namespace halfsilver
