#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

// The C++ side of shaders/shared/structs.h.
namespace halfsilver::shared {

using glm::mat4;
using glm::vec4;
using uint = std::uint32_t;

#include "shared/bindings.h"
#include "shared/structs.h"

static_assert(sizeof(VertexAttributes) == 64);
static_assert(sizeof(GpuTexture) == 32);
static_assert(sizeof(GpuMaterial) == 80 + 7 * 32);
static_assert(offsetof(GpuMaterial, textures) == 80);
static_assert(sizeof(GpuLight) == 64 + 6 * 64);
static_assert(sizeof(Ray) == 48);
static_assert(sizeof(RayCount) == 32);
static_assert(sizeof(ListBuild) == 48);
static_assert(sizeof(Hit) == 16);
static_assert(sizeof(HitSurface) == 32);
static_assert(sizeof(FrameConstants) == 64 + 9 * 16 + 64);

}  // namespace halfsilver::shared
