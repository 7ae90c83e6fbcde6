#pragma once

#include <filesystem>

#include "scene/model.h"

namespace halfsilver {

// Reads a glTF 2.0 scene (.gltf or .glb, told apart by content) with everything that it names, flattened at rest.
// What could not be taken as it stands is said in Model::warnings. Throws Error (badInput), "file: what: where", for
// anything unusable; no input makes it crash or allocate without bound.
// Source: the glTF 2.0 specification of the Khronos Group.
Model loadGltf(const std::filesystem::path& file);

}  // namespace halfsilver
