#pragma once

#include <array>

#include "io/gltf_document.h"

namespace halfsilver::gltf {

// One primitive in its mesh's space, ready to be placed by nodes.
struct Geometry {
  Instance shape;  // rest, targets, joints, weights, mesh, primitive; the placing node fills the rest
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint8_t> finite;  // 0 for a vertex whose position is not; it is moved to zero
  std::uint32_t material = 0;        // into the scene's materials
  std::uint32_t largestJoint = 0;
  std::size_t points = 0, lines = 0;  // if the primitive is of these: it has no triangles then
};

// Reads a primitive as triangles with normals and, if its material has a normal texture, tangents. Only
// counted if it consists of points or lines. Adds the default material to `materials` if the primitive has none.
// `variant` is one of the document's, or -1.
Geometry readPrimitive(const Document& document, Diagnostics& diagnostics, int mesh, int primitive, int variant,
                       std::vector<Material>& materials, std::optional<std::uint32_t>& defaultMaterial);

}  // namespace halfsilver::gltf
