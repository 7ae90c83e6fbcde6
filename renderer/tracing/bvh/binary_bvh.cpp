#include "tracing/bvh/binary_bvh.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <numeric>
#include <thread>

#include "tracing/bvh/wide_bvh.h"

namespace halfsilver {
namespace {

constexpr int kBins = 16;
// Cost of a node's visit in tests of triangles: four boxes against one triangle.
constexpr float kVisitCost = 1.0f;
// Subtrees that a thread takes at once.
constexpr std::uint32_t kMinTask = 4096;

using Node = BinaryBvh::Node;

struct Bin {
  Bounds box;
  std::uint32_t count = 0;
};

struct Plane {
  int axis = -1;
  int bin = 0;  // the first behind it
  float cost = std::numeric_limits<float>::max();
};

class Builder {
 public:
  Builder(std::span<const Bounds> boxes, Split split) : boxes_(boxes), split_(split) {
    bvh_.nodes.resize(std::max<std::size_t>(1, 2 * boxes.size()));
    bvh_.triangles.resize(boxes.size());
    std::iota(bvh_.triangles.begin(), bvh_.triangles.end(), 0u);
  }

  BinaryBvh build(unsigned threads) {
    Node& root = bvh_.nodes[0];
    root.count = static_cast<std::uint32_t>(boxes_.size());
    for (const Bounds& box : boxes_) root.box = joined(root.box, box);
    std::vector<std::uint32_t> tasks = {0};
    // The largest subtree is split until there is work for all threads.
    const auto larger = [this](std::uint32_t a, std::uint32_t b) { return nodes(a).count < nodes(b).count; };
    while (threads > 1 && tasks.size() < 4 * threads) {
      const auto largest = std::max_element(tasks.begin(), tasks.end(), larger);
      if (nodes(*largest).count < kMinTask || !divide(*largest)) break;
      const std::uint32_t left = nodes(*largest).left;
      *largest = left;
      tasks.push_back(left + 1);
    }
    std::atomic<std::size_t> next{0};
    const auto work = [&] {
      for (std::size_t i = next.fetch_add(1); i < tasks.size(); i = next.fetch_add(1)) finish(tasks[i]);
    };
    {
      std::vector<std::jthread> helpers;
      for (unsigned i = 1; i < std::min<std::size_t>(threads, tasks.size()); ++i) helpers.emplace_back(work);
      work();
    }
    bvh_.nodes.resize(used_);
    return std::move(bvh_);
  }

 private:
  Node& nodes(std::uint32_t number) { return bvh_.nodes[number]; }

  void finish(std::uint32_t root) {
    std::vector<std::uint32_t> open = {root};
    while (!open.empty()) {
      const std::uint32_t number = open.back();
      open.pop_back();
      if (!divide(number)) continue;
      open.push_back(nodes(number).left);
      open.push_back(nodes(number).left + 1);
    }
  }

  // False if the node stays a leaf.
  bool divide(std::uint32_t number) {
    Node& node = nodes(number);
    if (node.count < 2) return false;
    const auto begin = bvh_.triangles.begin() + node.first, end = begin + node.count;
    Bounds centers;
    for (auto i = begin; i != end; ++i) centers.add(boxes_[*i].center());
    auto middle = begin;
    if (split_ == Split::surfaceArea) {
      const Plane plane = bestPlane(std::span(begin, end), centers);
      const float area = halfArea(node.box);
      const bool splitPays = plane.cost + kVisitCost * area < static_cast<float>(node.count) * area;
      if (node.count <= BVH_MAX_LEAF && !splitPays) return false;
      if (plane.axis >= 0)
        middle = std::partition(
            begin, end, [&](std::uint32_t t) { return binOf(boxes_[t].center(), centers, plane.axis) < plane.bin; });
    } else if (node.count <= BVH_MAX_LEAF) {
      return false;
    }
    // Centers that lie in one bin, or halves that were asked for.
    if (middle == begin || middle == end) {
      const glm::vec3 e = centers.extent();
      const int axis = e.x >= e.y && e.x >= e.z ? 0 : (e.y >= e.z ? 1 : 2);
      middle = begin + node.count / 2;
      std::nth_element(begin, middle, end, [&](std::uint32_t a, std::uint32_t b) {
        const float ca = boxes_[a].center()[axis], cb = boxes_[b].center()[axis];
        return ca < cb || (ca == cb && a < b);
      });
    }
    const std::uint32_t left = used_.fetch_add(2), half = static_cast<std::uint32_t>(middle - begin);
    node.left = left;
    nodes(left).first = node.first;
    nodes(left).count = half;
    nodes(left + 1).first = node.first + half;
    nodes(left + 1).count = node.count - half;
    for (auto i = begin; i != end; ++i) {
      Bounds& box = nodes(i < middle ? left : left + 1).box;
      box = joined(box, boxes_[*i]);
    }
    return true;
  }

  static int binOf(const glm::vec3& center, const Bounds& centers, int axis) {
    const float place = (center[axis] - centers.low[axis]) / (centers.high[axis] - centers.low[axis]);
    return std::clamp(static_cast<int>(place * kBins), 0, kBins - 1);
  }

  Plane bestPlane(std::span<const std::uint32_t> triangles, const Bounds& centers) const {
    Plane best;
    for (int axis = 0; axis < 3; ++axis) {
      if (!(centers.high[axis] > centers.low[axis])) continue;
      std::array<Bin, kBins> bins;
      for (const std::uint32_t triangle : triangles) {
        Bin& bin = bins[static_cast<std::size_t>(binOf(boxes_[triangle].center(), centers, axis))];
        bin.box = joined(bin.box, boxes_[triangle]);
        ++bin.count;
      }
      std::array<float, kBins> behind{};  // cost of bin i and those after it
      Bin sum;
      for (std::size_t i = kBins; i-- > 1;) {
        sum = {joined(sum.box, bins[i].box), sum.count + bins[i].count};
        behind[i] = static_cast<float>(sum.count) * halfArea(sum.box);
      }
      sum = {};
      for (std::size_t i = 1; i < kBins; ++i) {
        sum = {joined(sum.box, bins[i - 1].box), sum.count + bins[i - 1].count};
        const float cost = static_cast<float>(sum.count) * halfArea(sum.box) + behind[i];
        if (sum.count > 0 && sum.count < triangles.size() && cost < best.cost) best = {axis, static_cast<int>(i), cost};
      }
    }
    return best;
  }

  std::span<const Bounds> boxes_;
  Split split_;
  BinaryBvh bvh_;
  std::atomic<std::uint32_t> used_{1};  // nodes
};

}  // namespace

BinaryBvh buildBinaryBvh(std::span<const Bounds> boxes, Split split, unsigned threads) {
  return Builder(boxes, split).build(std::max(1u, threads));
}

}  // namespace halfsilver
