// Deferred shading: direct light and sky light of every pixel, without reflections.
#include "lib/gbuffer_surface.glsl"
#include "lib/lights.glsl"
#include "lib/sky.glsl"
#include "shared/passes/shade.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = IMAGE_SHADED) writeonly uniform image2D shaded;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (pixel.x >= int(frame.width) || pixel.y >= int(frame.height)) return;
  vec4 position = texelFetch(gPosition, pixel, 0);
  if (position.w <= 0.0) {
    imageStore(shaded, pixel, vec4(skyRadiance(normalize(pixelRay(pixel)), 0.0), 1.0));
    return;
  }
  Surface s = surfaceOfPixel(pixel, position.xyz);
  imageStore(shaded, pixel, directLighting(s, normalize(-fromCamera(position.xyz))));
}
