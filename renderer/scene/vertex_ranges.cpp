#include "scene/vertex_ranges.h"

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

}  // namespace halfsilver
