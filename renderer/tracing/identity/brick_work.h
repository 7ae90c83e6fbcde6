#pragma once

#include <halfsilver/shared_structs.h>

// The C++ side of shaders/shared/passes/identity.h.
namespace halfsilver::shared {

#include "shared/passes/identity.h"

static_assert(offsetof(BrickWork, vertexCount) == 0);  // an indirect draw begins here
static_assert(offsetof(BrickWork, instanceCount) == 4);
static_assert(offsetof(BrickWork, firstVertex) == 8);
static_assert(offsetof(BrickWork, firstInstance) == 12);
static_assert(offsetof(BrickWork, requestedBricks) == 16);
static_assert(offsetof(BrickWork, totalWords) == 20);
static_assert(offsetof(BrickWork, headerWords) == 24);
static_assert(offsetof(BrickWork, longestRun) == 28);
static_assert(offsetof(BrickWork, staleWords) == 32);
static_assert(offsetof(BrickWork, staleHeaderWords) == 36);
static_assert(sizeof(BrickWork) == 48);

}  // namespace halfsilver::shared
