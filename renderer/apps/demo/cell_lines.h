#pragma once

#include <vector>

#include <halfsilver/scene.h>
#include <halfsilver/structure_cells.h>
#include "apps/demo/options.h"
#include "apps/demo/overlay.h"

namespace halfsilver::demo {

// The edges of a structure's cells as the camera sees them, the nearest few thousand cells; voxels are colored by the
// length of their lists. `aspect` is the picture's width over its height.
std::vector<Segment> cellLines(const StructureCells& structure, Cells cells, const Camera& camera, float aspect);

}  // namespace halfsilver::demo
