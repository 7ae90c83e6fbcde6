// Spreads marks along one axis of the picture: a pixel gets those of all within `reach`. A kernel of positive weights
// over the shadow test's answers would leave a value between light and dark at exactly the pixels that have both.
#include "lib/frame.glsl"
#include "lib/shadow_marks.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = IMAGE_SHADOW_MARKS, rg32ui) writeonly uniform uimage2DArray marksImage;

uniform int reach;    // pixels
uniform uint upward;  // 1: along y, else along x

void main() {
  ivec3 place = ivec3(gl_GlobalInvocationID);
  if (place.x >= int(frame.width) || place.y >= int(frame.height)) return;
  ivec2 along = upward != 0u ? ivec2(0, 1) : ivec2(1, 0), last = ivec2(frame.width, frame.height) - 1;
  uvec2 marks = uvec2(0u);
  for (int step = -reach; step <= reach; ++step) {
    ivec2 other = clamp(place.xy + step * along, ivec2(0), last);
    marks |= texelFetch(shadowMarks, ivec3(other, place.z), 0).xy;
  }
  imageStore(marksImage, place, uvec4(marks, 0u, 0u));
}
