#pragma once

#include <halfsilver/shared_structs.h>

// The C++ side of shaders/shared/passes/identity.h.
namespace halfsilver::shared {

#include "shared/passes/identity.h"

static_assert(offsetof(BrickWork, requestedBricks) == 0);
static_assert(offsetof(BrickWork, totalWords) == 4);
static_assert(offsetof(BrickWork, headerWords) == 8);
static_assert(offsetof(BrickWork, longestRun) == 12);
static_assert(offsetof(BrickWork, staleWords) == 16);
static_assert(offsetof(BrickWork, staleHeaderWords) == 20);
static_assert(sizeof(BrickWork) == 32);

}  // namespace halfsilver::shared
