#pragma once

#include <array>

namespace halfsilver {

// What rays are for, in the order of RAY_... in shaders/shared/rays.h.
inline constexpr std::array kRayKindNames{"reflection", "refraction", "shadow", "occlusion", "scattered", "through"};

}  // namespace halfsilver
