#pragma once

#include <cstddef>

#include <halfsilver/model.h>

// Scenes with any number of triangles and lights, each with a camera. What the camera sees stays alike, so that nothing
// else grows with them.
namespace halfsilver::bench {

// A knot between two mirrors that face each other, above a third: always the same surface, in finer and finer
// triangles. Within 1 % of the number asked for, at least 1000.
Model subdividedScene(std::size_t triangles, std::size_t lights = 1);

// Pillars of a fixed size at fixed distances on a mirror that grows with their number: a larger and larger world around
// the same place. Within 98 triangles, a pillar, of the number asked for.
Model crowdedScene(std::size_t triangles, std::size_t lights = 1);

}  // namespace halfsilver::bench
