#include "scene/vertex_ranges.h"

#include <halfsilver/error.h>

namespace halfsilver {

std::vector<VertexRange> mergeRanges(std::span<const VertexRange> ranges) {
  std::vector<VertexRange> sorted(ranges.begin(), ranges.end());
  std::erase_if(sorted, [](const VertexRange& range) { return range.count == 0; });
  std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<VertexRange> merged;
  for (const VertexRange& range : sorted) {
    if (merged.empty() || range.first >= merged.back().first + merged.back().count)
      merged.push_back(range);
    else
      merged.back().count = std::max(merged.back().count, range.first + range.count - merged.back().first);
  }
  return merged;
}

void refusePosed(const SceneChange& change, std::span<const PosedPart> posed) {
  const std::vector<VertexRange> moved = mergeRanges(change.moved);
  const auto overlap = [](const TriangleRange& a, const TriangleRange& b) {
    return a.count > 0 && b.count > 0 && std::uint64_t{a.first} < std::uint64_t{b.first} + b.count &&
           std::uint64_t{b.first} < std::uint64_t{a.first} + a.count;
  };
  for (const PosedPart& part : posed) {
    if (part.vertices.count > 0 &&
        touchesRange(moved, part.vertices.first, part.vertices.first + part.vertices.count - 1))
      throw Error(ErrorKind::usage, "update(): the vertices are those of an animated instance, which pose() moves");
    if (std::ranges::any_of(change.turned, [&](const TriangleRange& range) { return overlap(range, part.triangles); }))
      throw Error(ErrorKind::usage, "update(): the triangles are those of an animated instance, which pose() turns");
  }
}

}  // namespace halfsilver
