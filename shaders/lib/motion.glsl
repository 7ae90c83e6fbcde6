// Where things were in the frame before. Now and then go through the same arithmetic, so what stays has a motion of 0.
#include "lib/frame.glsl"
#include "lib/triangles.glsl"
#include "shared/passes/motion.h"

layout(std140, binding = UBO_PREVIOUS_FRAME) uniform PreviousFrameBlock { FrameConstants previousFrame; };
layout(std430, binding = SSBO_PREVIOUS_POSITIONS) readonly buffer PreviousPositionBlock { float previousPositions[]; };

vec3 previousVertex(uint vertex) {
  return vec3(previousPositions[3u * vertex], previousPositions[3u * vertex + 1u], previousPositions[3u * vertex + 2u]);
}

// The point with these barycentrics, in this frame and in the one before.
void pointThenAndNow(uint triangle, vec2 barycentrics, out vec3 now, out vec3 before) {
  uvec4 corners = triangleAt(triangle);
  vec3 a = vertexPosition(corners.x), b = vertexPosition(corners.y), c = vertexPosition(corners.z);
  now = a + barycentrics.x * (b - a) + barycentrics.y * (c - a);
  a = previousVertex(corners.x);
  b = previousVertex(corners.y);
  c = previousVertex(corners.z);
  before = a + barycentrics.x * (b - a) + barycentrics.y * (c - a);
}

// Pixels from the picture's center to where the camera of `f` sees the direction; far outside if it is behind it.
vec2 seenAt(vec3 fromEye, FrameConstants f) {
  float along = dot(fromEye, f.forward);
  vec2 screen = vec2(dot(fromEye, f.right) / dot(f.right, f.right), dot(fromEye, f.up) / dot(f.up, f.up));
  vec2 size = vec2(f.width, f.height);
  if (f.parallel != 0u) return 0.5 * size * screen;
  return along > 0.0 ? 0.5 * size * screen / along : 4.0 * size;
}

// Pixels that a point has moved on the screen since the frame before, to the right and up.
vec2 motionOf(vec3 now, vec3 before) { return seenAt(now - frame.eye, frame) - seenAt(before - previousFrame.eye, previousFrame); }

// The same of what is infinitely far away.
vec2 motionOfDirection(vec3 direction) {
  if (frame.parallel != 0u || previousFrame.parallel != 0u) return vec2(0.0);  // the sky has one color
  return seenAt(direction, frame) - seenAt(direction, previousFrame);
}
