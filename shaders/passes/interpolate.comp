// Pixels whose surface is not known get the mean color of those around them, the nearer the more.
#include "lib/pixel_light.glsl"
#include "shared/passes/shade.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = IMAGE_SHADED, rgba32f) writeonly uniform image2D shaded;

uniform int reach;  // pixels

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (pixel.x >= int(frame.width) || pixel.y >= int(frame.height)) return;
  if (!isInterpolated(pixel)) return;
  vec4 sum = vec4(0.0);
  for (int y = -reach; y <= reach; ++y)
    for (int x = -reach; x <= reach; ++x) {
      ivec2 other = pixel + ivec2(x, y);
      if (any(lessThan(other, ivec2(0))) || any(greaterThanEqual(other, ivec2(frame.width, frame.height)))) continue;
      if (isInterpolated(other)) continue;
      PixelLight light = pixelLight(other);
      sum += exp2(-float(x * x + y * y)) * vec4(light.surface + light.reflected, 1.0);
    }
  imageStore(shaded, pixel, vec4(sum.a > 0.0 ? sum.rgb / sum.a : vec3(0.0), 1.0));
}
