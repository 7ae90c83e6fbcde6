#pragma once

#include <halfsilver/scene.h>
#include "io/gltf_document.h"

namespace halfsilver::gltf {

// Fills the scene's materials, in the file's order, and the textures that they use. An image used both as color and
// as data becomes two textures.
void buildMaterials(const Document& document, Diagnostics& diagnostics, Scene& scene);

// Width and height that a PNG or JPEG file declares; {0, 0} if it is neither.
glm::uvec2 imageSize(std::span<const std::uint8_t> bytes);

}  // namespace halfsilver::gltf
