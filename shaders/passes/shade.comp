// Deferred shading of a band of the screen: direct light and sky light of every pixel, without reflections. With
// SHADOW_MARKS lights that are in doubt at a pixel are left to rays, and the others are what the marks say. With GLOSSY
// what the pixel's surface reflects where the sky is hidden comes with GBuffer::seen. With COATS see lib/coat.glsl.
#include "lib/gbuffer_surface.glsl"

#ifdef GLOSSY
bool asksScreen = false;
#endif

#include "lib/lights.glsl"
#include "lib/sky.glsl"
#include "shared/passes/shade.h"
#ifdef SHADOW_MARKS
#include "lib/shadow_marks.glsl"
#endif

layout(local_size_x = 8, local_size_y = 8) in;

#ifdef GLOSSY
layout(rgba32f, binding = IMAGE_SEEN) uniform writeonly image2D seen;
layout(r16f, binding = IMAGE_OCCLUSION) uniform writeonly image2D occlusion;
#endif

uniform int firstRow;  // of the band
uniform int rows;

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
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy) + ivec2(0, firstRow);
  if (pixel.x >= int(frame.width) || pixel.y >= firstRow + rows) return;
#ifdef GLOSSY
  imageStore(seen, pixel, vec4(0.0, 0.0, 0.0, -1.0));  // nobody has looked yet
#endif
  if (texelFetch(gVisibility, pixel, 0).x == 0u) {
    imageStore(shaded, pixel, vec4(skyRadiance(normalize(pixelRay(pixel)), 0.0), 1.0));
    imageStore(reflection, pixel, vec4(0.0));
    return;
  }
  Surface s = surfaceOfPixel(pixel);
  vec3 toEye = normalize(-fromCamera(s.position));
#ifdef GLOSSY
  imageStore(occlusion, pixel, vec4(s.occlusion));
  asksScreen = !goesOn(facingAt(pixel));
#ifdef COATS
  asksScreen = asksScreen && texelFetch(gCoat, pixel, 0).z >= 0.0;  // and not the mirror above it
#endif
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
  imageStore(reflection, pixel, vec4(0.0));
}
