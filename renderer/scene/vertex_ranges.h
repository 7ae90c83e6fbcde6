#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include <halfsilver/model.h>
#include <halfsilver/scene_change.h>
#include <halfsilver/scene_core.h>

namespace halfsilver {

// Sorted, without empty ranges and overlaps. Ranges that follow one another stay apart.
std::vector<VertexRange> mergeRanges(std::span<const VertexRange> ranges);

// The first of merged ranges that ends behind a vertex; their number if there is none.
inline std::size_t firstRangeFrom(std::span<const VertexRange> merged, std::uint32_t vertex) {
  const auto range = std::partition_point(merged.begin(), merged.end(),
                                          [&](const VertexRange& each) { return each.first + each.count <= vertex; });
  return static_cast<std::size_t>(range - merged.begin());
}

// Whether merged ranges hold a vertex of first..last, inclusive.
inline bool touchesRange(std::span<const VertexRange> merged, std::uint32_t first, std::uint32_t last) {
  const std::size_t range = firstRangeFrom(merged, first);
  return range < merged.size() && merged[range].first <= last;
}

// Throws Error (usage) if a caller's change moves vertices or turns triangles of posed parts, which are not his to
// move.
void refusePosed(const SceneChange& change, std::span<const PosedPart> posed);

}  // namespace halfsilver
