#pragma once

#include <halfsilver/scene.h>
#include "bench/modes/mode.h"

namespace halfsilver::bench {

// The memory of each method's structure, scene by scene: memory.csv, .json, .svg and .png.
Mode memoryMode();

// Fragments in a single A-buffer over fragments in three, as predicted by the triangles' normals if each triangle is
// stored along its own dominant axis: along each axis a triangle makes fragments in proportion to its projected area,
// counted in texels. If the bounds are a cube that is max|n| / (|nx| + |ny| + |nz|), from 1/3 (diagonal) to 1 (facing
// an axis). 1 for a scene without area.
double singleOverThree(const Scene& scene);

}  // namespace halfsilver::bench
