#pragma once

#include <halfsilver/scene.h>
#include "io/gltf_document.h"

namespace halfsilver::gltf {

// Fills the scene's materials, in the file's order, and the textures that they use. An image used both as color and
// as data becomes two textures.
void buildMaterials(const Document& document, Diagnostics& diagnostics, Scene& scene);

}  // namespace halfsilver::gltf
