// All pixels that show a surface, as the camera's rays.
#include "effects/common/queue_pixels.glsl"
#include "lib/gbuffer.glsl"

void main() {
  ivec2 pixel = bandPixel();
  beginTile();
  bool surface = all(lessThan(pixel, ivec2(frame.width, frame.height))) && texelFetch(gVisibility, pixel, 0).x != 0u;
  bool selected = frame.selectMode != 0u && surface;
  queuePixel(pixel, selected, selected && inFraction(pixel));
}
