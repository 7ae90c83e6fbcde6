#pragma once

#include <array>

namespace halfsilver {

enum class Buffers {
  single,  // a fragment is stored in the A-buffer of its voxel's axis only
  three    // in those of all three axes
};
enum class Lists { pages, linked };
enum class InsideTest {
  plane,  // the side of the plane of the fragment nearest in depth
  depth   // how many of the texel's fragments lie in front of it (Hu et al. 2014)
};
constexpr auto choiceNames(Buffers) { return std::array{"single", "three"}; }
constexpr auto choiceNames(Lists) { return std::array{"pages", "linked"}; }
constexpr auto choiceNames(InsideTest) { return std::array{"plane", "depth"}; }

// Settings of trace.method=attributes: fragments with all surface attributes (Hu et al. 2014; Kastrati & Goswami 2017).
struct AttributeSettings {
  int pageSize = 4;  // entries per page, 1..64
  Buffers buffers = Buffers::single;
  Lists lists = Lists::pages;
  bool sorted = false;  // entries of a texel sorted by depth after the build; linked lists only

  int steps = 0;                        // linear steps in a voxel, 0..64; 0: full 2D-DDA
  int refinements = 6;                  // binary search steps after a crossing, 0..32
  int anyHitRefinements = 6;            // the same of rays that need no exact hit (shadows, occlusion)
  InsideTest test = InsideTest::plane;  // what decides on which side of a surface a point lies

  bool operator==(const AttributeSettings&) const = default;

  // visit(name, value, low, high, help) for each setting, see settings.cpp.
  template <class Self, class Visitor>
  static void visit(Self& s, Visitor&& visit) {
    visit("abuffer.page_size", s.pageSize, 1, 64, "entries per page");
    visit("abuffer.buffers", s.buffers, 0, 0, "one buffer per fragment, or all three");
    visit("abuffer.lists", s.lists, 0, 0, "pages or a linked list of entries");
    visit("abuffer.sorted", s.sorted, 0, 1, "entries are sorted by depth after the build");
    visit("search.steps", s.steps, 0, 64, "linear steps in a voxel; 0: full 2D-DDA");
    visit("search.refinements", s.refinements, 0, 32, "binary search steps");
    visit("search.any_hit_refinements", s.anyHitRefinements, 0, 32, "the same of shadow and occlusion rays");
    visit("search.test", s.test, 0, 0, "what decides whether a point lies inside an object");
  }
};

}  // namespace halfsilver
