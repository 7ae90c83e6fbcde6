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
  uint visible = texelFetch(gVisibility, pixel, 0).x;
  if (visible == 0u) return;
  Surface s = surfaceOfPixel(pixel);
  vec3 toEye = -fromCamera(s.position);
  sendToLights(s, normalize(toEye), visible - 1u, uint(pixel.y) * frame.width + uint(pixel.x),
               vec3(1.0), length(toEye), 0u);
}
