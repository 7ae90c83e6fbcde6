// Brings a picture of radiance to the display.
#include "lib/display.glsl"
#include "lib/target.glsl"
#include "shared/passes/display.h"

layout(binding = UNIT_PICTURE) uniform sampler2D picture;

uniform float scale;

void main() {
  ivec2 pixel = targetPixel();
  vec3 radiance = scale * texelFetch(picture, pixel, 0).rgb;
#ifdef LINEAR
  color = vec4(radiance, 1.0);
#else
  color = vec4(dithered(displayed(radiance), pixel), 1.0);
#endif
}
