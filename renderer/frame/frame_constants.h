#pragma once

#include <halfsilver/bounds.h>
#include <halfsilver/products.h>
#include <halfsilver/scene.h>
#include <halfsilver/settings.h>
#include <halfsilver/shared_structs.h>

namespace halfsilver {

// Constants of one frame. viewProjection is a reversed-Z projection for a clip space of depth 0..1 (1 at the near
// plane, 0 at the far plane or at infinity); frame.farPlane keeps the far plane, 0 if there is none. Planes that the
// camera leaves at 0: near just before the scene's bounds or a small part of their diagonal, far at infinity.
// Throws Error (usage) for a size below 1 or a camera without a direction or a field of view.
shared::FrameConstants makeFrameConstants(const Camera& camera, const Bounds& bounds, const Sky& sky,
                                          const Settings& settings, int width, int height, const LightRanges& lights);

// Hits nearer than this are ignored by every method: 1e-5 of the diagonal of the bounds. Meters.
float smallestHitDistance(const Bounds& bounds);

}  // namespace halfsilver
