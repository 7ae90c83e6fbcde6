#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include <halfsilver/bounds.h>
#include <halfsilver/products.h>
#include <halfsilver/scene.h>
#include <halfsilver/settings.h>
#include <halfsilver/shared_structs.h>
#include <halfsilver/target.h>

namespace halfsilver {

// Constants of one frame. viewProjection is a reversed-Z projection for a clip space of depth 0..1 (1 at the near
// plane, 0 at the far plane or at infinity); frame.farPlane keeps the far plane, 0 if there is none. Planes that the
// camera leaves at 0: near just before the scene's bounds or a small part of their diagonal, far at infinity; what
// is drawn begins at frame.drawnNear, which is next to nothing then.
// `jitter`: where the pixels' samples lie, from their centers, in pixels; viewProjection brings samples to the centers.
// Throws Error (usage) for a size below 1 or a camera without a direction or a field of view.
shared::FrameConstants makeFrameConstants(const Camera& camera, const Bounds& bounds, const Sky& sky,
                                          const Settings& settings, int width, int height, const LightRanges& lights,
                                          const glm::vec2& jitter = glm::vec2(0));

// See Renderer::matrices(). The same planes and errors as above.
CameraMatrices cameraMatrices(const Camera& camera, const Bounds& bounds, const Target& target);

// Where sample number `sample` of a pixel lies, from its center, in pixels (-0.5..0.5): the first at the center, every
// beginning of the sequence evenly spread over the pixel (the first two dimensions of Sobol 1967, scrambled so that the
// mean place of the first 4, 8, 16, ... is the center within 0.001 pixel). The mean of all is a box filter one pixel
// wide.
glm::vec2 sampleOffset(std::uint32_t sample);

// Pixels that things have moved to the right and up from the picture of one camera to that of another, on average over
// the first, if all of them are as far away as its target. 0 if they do not see the same. Errors as above.
glm::dvec2 meanMotion(const Camera& before, const Camera& now, const glm::ivec2& size);

// Hits nearer than this are ignored by every method if a ray starts where coordinates are largest; elsewhere fewer are
// (NEAREST_SHARE). Meters.
float smallestHitDistance(const Bounds& bounds);

}  // namespace halfsilver
