#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include <halfsilver/bounds.h>
#include <halfsilver/products.h>

namespace halfsilver {

inline constexpr std::size_t kMaxChangedRectangles = 8;

// The parts of a view that boxes may cover, in texels of the layer (x, y, width, height) and with a texel to spare.
// Boxes that are close to one another share a rectangle; those that are not have one each, up to kMaxChangedRectangles.
// From then on the two are joined that waste the least.
std::vector<glm::ivec4> changedRectangles(const ShadowView& view, std::span<const Bounds> boxes);

// What a view sees through a rectangle of its own, in clip coordinates; with a texel to spare, too.
glm::mat4 clipTo(const ShadowView& view, const glm::ivec4& rectangle);

}  // namespace halfsilver
