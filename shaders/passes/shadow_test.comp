// The answers of the shadow maps, pixel by pixel: two bits per light, see lib/shadow_marks.glsl. A filtered answer
// between light and dark is both, as is a light whose map cannot know: one that has an extent, or none.
#include "lib/gbuffer_surface.glsl"
#include "lib/lights.glsl"
#include "shared/passes/shadow_marks.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = IMAGE_SHADOW_MARKS, rg32ui) writeonly uniform uimage2DArray marksImage;

const float LEAST = 1e-4;  // of an answer: the weights of a filter are 1 together but for rounding

bool mapKnows(uint light) {
  int type = int(lightTexel(light, LIGHT_DIRECTION).w);
  return type != LIGHT_RECTANGLE && type != LIGHT_SPHERE && lightTexel(light, LIGHT_SHADOW).z >= 0.0;
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (pixel.x >= int(frame.width) || pixel.y >= int(frame.height)) return;
  uint layer = gl_GlobalInvocationID.z, first = layer * LIGHTS_PER_MARK;
  uint count = min(frame.directLights - first, LIGHTS_PER_MARK);
  uvec2 marks = uvec2(0u);
  if (texelFetch(gVisibility, pixel, 0).x != 0u) {
    Surface s = surfaceOfPixel(pixel);
    uint pending = 0u;
    for (uint i = 0u; i < count; ++i) {
      if (!mayLight(first + i, s))
        marks.y |= 1u << i;
      else if (mapKnows(first + i))
        pending |= 1u << i;
      else
        marks |= 1u << i;
    }
    while (pending != 0u) {
      uint i = takeLight(pending);
      float lit = reachedBy(first + i, s).lit;
      if (lit > LEAST) marks.x |= 1u << i;
      if (lit < 1.0 - LEAST) marks.y |= 1u << i;
    }
  }
  imageStore(marksImage, ivec3(pixel, layer), uvec4(marks, 0u, 0u));
}
