// The frame's constants and the camera's rays.
#include "shared/bindings.h"
#include "shared/structs.h"

layout(std140, binding = UBO_FRAME) uniform FrameBlock { FrameConstants frame; };

// Of the pixel's center: -1..1 from left to right and from bottom to top. Row 0 is the bottom.
vec2 screenPosition(ivec2 pixel) {
  ivec2 size = ivec2(frame.width, frame.height);
  return vec2(2 * pixel + 1 - size) / vec2(size);
}

// From there to the pixel's sample, the same for all pixels.
vec2 sampleShift() { return 2.0 * frame.jitter / vec2(frame.width, frame.height); }

// Through the pixel's sample, not normalized: its component along frame.forward is 1.
vec3 pixelRay(ivec2 pixel) {
  if (frame.parallel != 0u) return frame.forward;
  precise vec2 screen = screenPosition(pixel) + sampleShift();
  precise vec3 ray = frame.forward + screen.x * frame.right + screen.y * frame.up;
  return ray;
}

// Where that ray starts.
vec3 pixelOrigin(ivec2 pixel) {
  if (frame.parallel == 0u) return frame.eye;
  precise vec2 screen = screenPosition(pixel) + sampleShift();
  precise vec3 origin = frame.eye + screen.x * frame.right + screen.y * frame.up;
  return origin;
}

// From where the camera's ray starts to a point.
vec3 fromCamera(vec3 position) {
  vec3 fromEye = position - frame.eye;
  return frame.parallel == 0u ? fromEye : dot(fromEye, frame.forward) * frame.forward;
}

// Width of a pixel's cone behind so many meters of its way.
float coneWidth(float way) { return frame.parallel == 0u ? way * frame.pixelCone : frame.pixelCone; }
