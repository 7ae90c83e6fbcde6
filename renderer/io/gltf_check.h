#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string_view>

#include "io/gltf_document.h"

namespace halfsilver::gltf {

// Parses the JSON of a glTF file and checks what a parser that trusts it would stumble over: nesting, version,
// extensions, that lists contain objects, that indices and sizes are whole numbers in range. Throws through
// `diagnostics`.
nlohmann::json checkJson(std::string_view text, Diagnostics& diagnostics);

}  // namespace halfsilver::gltf
