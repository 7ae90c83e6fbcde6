#pragma once

#include <halfsilver/shared_structs.h>

// The C++ side of shaders/shared/passes/pose.h.
namespace halfsilver::shared {

#include "shared/passes/pose.h"

static_assert(offsetof(RestVertex, bitangentSign) == 12 && offsetof(RestVertex, normal) == 16);
static_assert(offsetof(RestVertex, tangent) == 32 && sizeof(RestVertex) == 48);
static_assert(offsetof(JointInfluences, weights) == 16 && sizeof(JointInfluences) == 32);
static_assert(offsetof(MorphWeight, weight) == 4 && sizeof(MorphWeight) == 8);
static_assert(sizeof(PoseMatrix) == 48);
static_assert(offsetof(PoseGroup, influences) == 16 && offsetof(PoseGroup, flags) == 32 && sizeof(PoseGroup) == 48);

}  // namespace halfsilver::shared
