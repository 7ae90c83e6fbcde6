#pragma once

namespace halfsilver {

// Settings of trace.method=identity: fragments that name their triangle, in lists that are built on demand.
struct IdentitySettings {
  float voxelsPerTriangle = 16;  // 0..1000, size of the grid; 0: voxels.resolution alone decides
  bool keep = true;              // what is built stays while the geometry does; false: built again in every frame

  bool operator==(const IdentitySettings&) const = default;

  // visit(name, value, low, high, help) for each setting, see settings.cpp.
  template <class Self, class Visitor>
  static void visit(Self& s, Visitor&& visit) {
    visit("voxels.per_triangle", s.voxelsPerTriangle, 0, 1000,
          "voxels per triangle; 0: voxels.resolution alone decides (identity)");
    visit("abuffer.keep", s.keep, 0, 1, "keep what is built while the geometry stays (identity)");
  }
};

}  // namespace halfsilver
