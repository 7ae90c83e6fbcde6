// The frame's constants and the camera's rays.
#include "shared/bindings.h"
#include "shared/structs.h"

layout(std140, binding = UBO_FRAME) uniform FrameBlock { FrameConstants frame; };

// Through the pixel's centre, not normalised: its component along frame.forward is 1. Row 0 is the bottom.
vec3 pixelRay(ivec2 pixel) {
  ivec2 size = ivec2(frame.width, frame.height);
  vec2 screen = vec2(2 * pixel + 1 - size) / vec2(size);
  return frame.forward.xyz + screen.x * frame.right.xyz + screen.y * frame.up.xyz;
}
