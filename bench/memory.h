#pragma once

#include <halfsilver/scene.h>
#include "bench/mode.h"

namespace halfsilver::bench {

// The bytes of each method's structure, scene by scene: memory.csv, .json, .svg and .png.
Mode memoryMode();

// Fragments in a single A-buffer per fragment in three, as the triangles' normals foretell it where each triangle is
// kept in its own dominant axis: a triangle makes fragments in proportion to its area as each axis sees it, counted in
// texels. In a cube of bounds that is max|n| / (|nx| + |ny| + |nz|), from 1/3 (diagonal) to 1 (facing an axis).
// 1 for a scene without area.
double singleOverThree(const Scene& scene);

}  // namespace halfsilver::bench
