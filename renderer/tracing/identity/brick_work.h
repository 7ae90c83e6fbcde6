#pragma once

#include <halfsilver/shared_structs.h>

// The C++ side of shaders/shared/passes/identity.h.
namespace halfsilver::shared {

#include "shared/passes/identity.h"

// Indirect dispatches begin here.
static_assert(offsetof(BrickWork, blockGroupsX) == 0);
static_assert(offsetof(BrickWork, triangleGroupsX) == 12);
static_assert(offsetof(BrickWork, buildGroupsX) == 24);
static_assert(offsetof(BrickWork, groupsPerBuildX) == 36);
static_assert(offsetof(BrickWork, pairGroupsX) == 48);
static_assert(offsetof(BrickWork, fewGroupsX) == 60);
static_assert(offsetof(BrickWork, heavyBricks) == 88);
static_assert(offsetof(BrickWork, buildCount) == 96);
static_assert(offsetof(BrickWork, requestedBricks) == 112);
static_assert(offsetof(BrickWork, waitingWords) == 116);
static_assert(offsetof(BrickWork, longestWaiting) == 120);
static_assert(offsetof(BrickWork, usedWords) == 124);
static_assert(offsetof(BrickWork, staleHeaderWords) == 140);
static_assert(offsetof(BrickWork, filledBelowX) == 144);
static_assert(offsetof(BrickWork, boundGroups) == 168);
static_assert(sizeof(BrickWork) == 240);

}  // namespace halfsilver::shared
