// Adds a frame's light to the sum of all samples of a picture.
#include "lib/pixel_light.glsl"
#include "shared/passes/accumulate.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(rgba32f, binding = IMAGE_SUM) uniform image2D sumImage;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, ivec2(frame.width, frame.height)))) return;
  PixelLight light = pixelLight(pixel);
  vec3 sum = imageLoad(sumImage, pixel).rgb;
  imageStore(sumImage, pixel, vec4(sum + (light.surface + light.reflected), 1.0));
}
