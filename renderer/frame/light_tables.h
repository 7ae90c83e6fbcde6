#pragma once

#include <cstdint>

#include <halfsilver/products.h>
#include <halfsilver/scene.h>

namespace halfsilver {

// Triangles that emit, to be chosen as often as their area at rest times the brightness of their factor says.
LightTable makeEmitters(const gl::Api& api, const Scene& scene);

// The sky in cells of equal solid angle, to be chosen as often as their brightness says: rows by height, columns around
// the vertical. A gradient has one column.
SkyTable makeSkyTable(const gl::Api& api, const Sky& sky);

}  // namespace halfsilver
