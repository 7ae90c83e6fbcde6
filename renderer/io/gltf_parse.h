#pragma once

#include <nlohmann/json_fwd.hpp>

#include "io/gltf_document.h"

namespace halfsilver::gltf {

// Fills the document from JSON that has been checked, but for its buffers and images. Takes apart what it hands to the
// parser. Throws through `diagnostics`.
void parse(nlohmann::json& root, Document& document, const Diagnostics& diagnostics);

}  // namespace halfsilver::gltf
