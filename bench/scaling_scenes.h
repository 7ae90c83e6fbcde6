#pragma once

#include <cstddef>

#include <halfsilver/model.h>

// Scenes of as many triangles and lights as one likes, each with a camera. What the camera sees stays alike, so that
// nothing else grows with them.
namespace halfsilver::bench {

// A knot between two mirrors that face each other, over a third: always the same surface in finer and finer triangles,
// within 1 % of as many as asked for (at least 1000).
Model subdividedScene(std::size_t triangles, std::size_t lights = 1);

// Pillars of a fixed size at fixed distances on a mirror that grows with their number: a larger and larger world around
// the same place. Within a pillar's 98 triangles of as many as asked for.
Model crowdedScene(std::size_t triangles, std::size_t lights = 1);

}  // namespace halfsilver::bench
