// Where the cube is captured: before the middle of the reflecting surfaces that the camera sees. One group, whose sums
// are added up in a fixed order.
#include "shared/bindings.h"
#include "shared/passes/captures.h"
#include "tracing/common/capture_samples.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = SSBO_PROBE) writeonly buffer ProbeBlock { vec4 probe; };

shared vec4 places[64];  // w: their number
shared vec3 ways[64];

// From the surfaces, of the scene's diagonal; nearer than a hundredth of that nothing is captured.
const float DISTANCE = 0.1;

void main() {
  int lane = int(gl_LocalInvocationIndex);
  vec4 position = vec4(0.0);
  vec3 normal = vec3(0.0);
  for (int i = lane; i < SAMPLES.x * SAMPLES.y; i += 64) {
    ReflectingPixel pixel = sampledPixel(i);
    if (!pixel.reflects) continue;
    position += vec4(pixel.position, 1.0);
    normal += pixel.normal;
  }
  places[lane] = position;
  ways[lane] = normal;
  barrier();
  if (lane != 0) return;
  for (int i = 1; i < 64; ++i) {
    position += places[i];
    normal += ways[i];
  }
  vec3 middle = position.w > 0.0 ? position.xyz / position.w : 0.5 * (frame.boundsLow + frame.boundsHigh);
  float size = length(normal);
  vec3 away = size > 0.0 ? normal / size : vec3(0.0, 1.0, 0.0);
  float distance = DISTANCE * frame.diagonal;
  probe = vec4(position.w > 0.0 ? middle + distance * away : middle, 0.01 * distance);
}
