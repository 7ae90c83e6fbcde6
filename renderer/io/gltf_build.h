#pragma once

#include <halfsilver/io.h>
#include <halfsilver/model.h>
#include "io/gltf_document.h"

namespace halfsilver::gltf {

// Flattens the document's scene at rest. The model takes over the warnings of `diagnostics`. Throws Error (usage) for
// an unknown variant.
Model build(const Document& document, const GltfOptions& options, Diagnostics& diagnostics);

}  // namespace halfsilver::gltf
