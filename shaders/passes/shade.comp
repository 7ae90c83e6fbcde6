// Deferred shading: direct light and sky light of every pixel, without reflections. With SHADOW_MARKS lights that are
// in doubt at a pixel are left to rays, and the others are what the marks say. With COATS see lib/coat.glsl.
#include "lib/gbuffer_surface.glsl"

// What the pixel's surface reflects where the sky is hidden comes with GBuffer::seen.
#define ASKS_SCREEN
bool asksScreen = false;

#include "lib/lights.glsl"
#include "lib/sky.glsl"
#include "shared/passes/shade.h"
#ifdef SHADOW_MARKS
#include "lib/shadow_marks.glsl"
#endif

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = IMAGE_SHADED) writeonly uniform image2D shaded;

#ifdef SHADOW_MARKS
// Of the lights that nothing around the pixel is hidden from.
vec3 undoubtedRadiance(ivec2 pixel, Surface s, vec3 toEye) {
  vec3 radiance = vec3(0.0);
  for (uint first = 0u; first < frame.directLights; first += LIGHTS_PER_MARK) {
    uvec2 marks = marksOf(pixel, first);
    uint pending = marks.x & ~marks.y;
    while (pending != 0u) {
      ReachedBy by = reachedBy(first + takeLight(pending), s);
      radiance += by.color * shadeBy(s, toEye, by.toLight);
    }
  }
  return radiance;
}
#endif

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (pixel.x >= int(frame.width) || pixel.y >= int(frame.height)) return;
  vec4 position = texelFetch(gPosition, pixel, 0);
  if (position.w <= 0.0) {
    imageStore(shaded, pixel, vec4(skyRadiance(normalize(pixelRay(pixel)), 0.0), 1.0));
    return;
  }
  Surface s = surfaceOfPixel(pixel, position.xyz);
  vec3 toEye = normalize(-fromCamera(position.xyz));
  asksScreen = frame.glossySamples != 0u && !goesOn(texelFetch(gNormal, pixel, 0));
#ifdef COATS
  asksScreen = asksScreen && texelFetch(gCoat, pixel, 0).z >= 0.0;  // and not the mirror above it
#endif
  vec4 lit = directLighting(s, toEye);
#ifdef SHADOW_MARKS
  if (!s.unlit) lit.rgb += undoubtedRadiance(pixel, s, toEye);
#endif
#ifdef COATS
  // Of the mirror that rays do not follow; the blend adds the other.
  if (s.coat > 0.0) {
    CoatBlend b = coatBlend(s, toEye, texelFetch(gCoat, pixel, 0).z < 0.0);  // as the G-buffer has it, ties as well
    lit.rgb += (b.ofCoat ? b.skyInBase * skyRadiance(reflect(-toEye, s.normal), s.roughness)
                         : b.skyInCoat * skyRadiance(reflect(-toEye, s.coatNormal), s.coatRoughness)) * lit.a;
  }
#endif
  imageStore(shaded, pixel, lit);
}
