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
static_assert(offsetof(BrickWork, pairGroupsX) == 60);
static_assert(offsetof(BrickWork, buildCount) == 76);
static_assert(offsetof(BrickWork, requestedBricks) == 92);
static_assert(offsetof(BrickWork, waitingWords) == 96);
static_assert(offsetof(BrickWork, longestWaiting) == 100);
static_assert(offsetof(BrickWork, usedWords) == 104);
static_assert(offsetof(BrickWork, staleHeaderWords) == 120);
static_assert(offsetof(BrickWork, filledBelowX) == 124);
static_assert(offsetof(BrickWork, growGroupsX) == 148);
static_assert(sizeof(BrickWork) == 184);

}  // namespace halfsilver::shared
