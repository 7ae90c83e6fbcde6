#pragma once

#include "apps/demo/demo.h"

namespace halfsilver {

// Opens the demo's module and plays. Throws Error: what the demo ended with, or noContext if there is no module.
void runDemo(const demo::Request& request);

}  // namespace halfsilver
