#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scene/model.h"

namespace halfsilver {

// Names of the scenes made in code, without the "builtin:" prefix; those that show failures are in failures.h.
std::vector<std::string> builtinNames();

// The scene, deterministic on every machine. Throws Error (badInput) for an unknown name, listing the known ones.
Model makeBuiltin(std::string_view name);

}  // namespace halfsilver
