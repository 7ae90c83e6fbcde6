// Blends deferred shading and reflection and brings the result to the display.
#include "lib/display.glsl"
#include "lib/pixel_light.glsl"
#include "lib/target.glsl"

void main() {
  ivec2 pixel = targetPixel();
  PixelLight light = pixelLight(pixel);
  vec3 radiance = light.surface + light.reflected;
#if defined LINEAR
  color = vec4(radiance, 1.0);
#elif defined UNDITHERED
  color = vec4(displayed(radiance), 1.0);
#else
  color = vec4(dithered(displayed(radiance), pixel), 1.0);
#endif
}
