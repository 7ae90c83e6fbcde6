#pragma once

#include <cstddef>
#include <span>

#include <halfsilver/renderer.h>

namespace halfsilver::bench {

// Share of the lanes that work, on average, if rays run in groups of `lanes` neighbors and a group ends with its
// slowest ray: the work of all rays over what their groups have time for. Steps and tests count alike. 1 without rays.
double lanesAtWork(std::span<const RayWork> work, std::size_t lanes);

}  // namespace halfsilver::bench
