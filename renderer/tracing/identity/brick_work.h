#pragma once

#include <halfsilver/shared_structs.h>

// The C++ side of shaders/shared/passes/identity.h.
namespace halfsilver::shared {

#include "shared/passes/identity.h"

// Indirect dispatches begin here.
static_assert(offsetof(BrickWork, brickGroupsX) == 0);
static_assert(offsetof(BrickWork, blockGroupsX) == 12);
static_assert(offsetof(BrickWork, triangleGroupsX) == 24);
static_assert(offsetof(BrickWork, buildGroupsX) == 36);
static_assert(offsetof(BrickWork, groupsPerBuildX) == 48);
static_assert(offsetof(BrickWork, buildCount) == 64);
static_assert(offsetof(BrickWork, requestedBricks) == 80);
static_assert(offsetof(BrickWork, waitingWords) == 84);
static_assert(offsetof(BrickWork, longestWaiting) == 88);
static_assert(offsetof(BrickWork, usedWords) == 92);
static_assert(offsetof(BrickWork, staleHeaderWords) == 108);
static_assert(sizeof(BrickWork) == 112);

}  // namespace halfsilver::shared
