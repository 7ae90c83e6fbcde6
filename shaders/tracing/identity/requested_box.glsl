// Whether rays wait for a brick of a box.
#include "tracing/identity/bricks.glsl"

// A box of more than `maxBricks` counts as if they did: nobody looks at its bricks.
bool requestedIn(ivec3 low, ivec3 high, float maxBricks) {
  vec3 size = vec3(high - low + 1);
  bool wanted = size.x * size.y * size.z > maxBricks;
  for (int z = low.z; z <= high.z && !wanted; ++z)
    for (int y = low.y; y <= high.y && !wanted; ++y)
      for (int x = low.x; x <= high.x && !wanted; ++x) wanted = requested(bricks[brickIndex(ivec3(x, y, z))]);
  return wanted;
}
