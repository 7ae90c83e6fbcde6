// Pixels that each pixel's surface has moved since the frame before, or the sky behind it.
#include "lib/motion.glsl"
#include "lib/triangle_point.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = UNIT_VISIBILITY) uniform usampler2D visibility;
layout(rg32f, binding = IMAGE_MOTION) uniform writeonly image2D motionImage;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, ivec2(frame.width, frame.height)))) return;
  uint visible = texelFetch(visibility, pixel, 0).x;
  vec2 motion = motionOfDirection(pixelRay(pixel));
  if (visible != 0u) {
    vec3 now, before;
    pointThenAndNow(visible - 1u, pointOnTriangle(visible - 1u, pixelOrigin(pixel), pixelRay(pixel)).barycentrics, now, before);
    motion = motionOf(now, before);
  }
  imageStore(motionImage, pixel, vec4(motion, 0.0, 0.0));
}
