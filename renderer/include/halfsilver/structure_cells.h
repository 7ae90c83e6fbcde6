#pragma once

#include <cstdint>
#include <vector>

#include <halfsilver/bounds.h>

namespace halfsilver {

// A cell of a structure that holds something; bounds are relative to Scene::origin.
struct StructureCell {
  Bounds bounds;
  std::uint32_t entries = 0;  // in its lists; 0 if the method keeps no list per cell
};

// To look at a structure, not to trace it.
struct StructureCells {
  std::vector<StructureCell> bricks;  // that are built; empty if the method has none
  std::vector<StructureCell> voxels;
};

}  // namespace halfsilver
