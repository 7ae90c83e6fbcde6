#pragma once

#include <halfsilver/shared_structs.h>

// The C++ side of shaders/shared/passes/identity.h.
namespace halfsilver::shared {

#include "shared/passes/identity.h"

// Indirect dispatches begin here.
static_assert(offsetof(BrickWork, brickGroupsX) == 0);
static_assert(offsetof(BrickWork, triangleGroupsX) == 12);
static_assert(offsetof(BrickWork, buildGroupsX) == 24);
static_assert(offsetof(BrickWork, buildCount) == 36);
static_assert(offsetof(BrickWork, requestedBricks) == 44);
static_assert(offsetof(BrickWork, waitingWords) == 48);
static_assert(offsetof(BrickWork, longestWaiting) == 52);
static_assert(offsetof(BrickWork, usedWords) == 56);
static_assert(offsetof(BrickWork, staleHeaderWords) == 72);
static_assert(sizeof(BrickWork) == 80);

}  // namespace halfsilver::shared
