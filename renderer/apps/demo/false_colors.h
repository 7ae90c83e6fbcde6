#pragma once

#include <cstdint>
#include <vector>

#include <halfsilver/image.h>
#include "apps/demo/options.h"

namespace halfsilver::demo {

// A picture of one of the contract's layers: RGBA, rows from the top. `exact` are the layers of the same view with
// exact rays, for View::error; lengths are shown against the scene's diagonal, in meters.
std::vector<std::uint8_t> falseColors(View view, const Image& layers, const Image* exact, double diagonal);

// What the colors mean, in a line.
const char* legend(View view);

}  // namespace halfsilver::demo
