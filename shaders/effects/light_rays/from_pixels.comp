// Rays to lights from the surfaces of a band of the screen; with SHADOW_MARKS to those that are in doubt there, with
// COATS see lib/coat.glsl.
#include "lib/gbuffer_surface.glsl"
#include "lib/lights.glsl"
#include "effects/light_rays/to_lights.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform int firstRow;  // of the band
uniform int rows;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy) + ivec2(0, firstRow);
  if (pixel.x >= int(frame.width) || pixel.y >= firstRow + rows) return;
  vec4 position = texelFetch(gPosition, pixel, 0);
  if (position.w <= 0.0) return;
  vec3 toEye = -fromCamera(position.xyz);
  uint triangle = texelFetch(gVisibility, pixel, 0).r - 1u;
  sendToLights(surfaceOfPixel(pixel, position.xyz), normalize(toEye), triangle, uint(pixel.y) * frame.width + uint(pixel.x),
               vec3(1.0), length(toEye), 0u);
}
