#pragma once

#include <halfsilver/model.h>
#include "io/gltf_document.h"

namespace halfsilver::gltf {

// Flattens the document's scene at rest. The model takes over the warnings of `diagnostics`.
Model build(const Document& document, Diagnostics& diagnostics);

}  // namespace halfsilver::gltf
