// Adds the light that rays from a band of the screen brought to its shaded pixels.
#include "effects/common/light_sums.glsl"
#include "effects/common/summed_light.glsl"
#include "lib/frame.glsl"
#include "shared/passes/light_rays.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = IMAGE_SHADED, rgba32f) uniform image2D shaded;

uniform int firstRow;  // of the band
uniform int rows;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy) + ivec2(0, firstRow);
  if (pixel.x >= int(frame.width) || pixel.y >= firstRow + rows) return;
  uint number = uint(pixel.y) * frame.width + uint(pixel.x);
  vec4 before = imageLoad(shaded, pixel);
  imageStore(shaded, pixel, vec4(before.rgb + radianceOf(lightSums[number - firstPixel]), before.a));
}
