// All pixels that show a surface, as the camera's rays.
#include "effects/common/queue_pixels.glsl"
#include "lib/gbuffer.glsl"

void main() {
  ivec2 pixel = bandPixel();
  beginTile();
  bool surface = all(lessThan(pixel, ivec2(frame.width, frame.height))) && texelFetch(gPosition, pixel, 0).w > 0.0;
  bool selected = frame.selectMode != 0u && surface;
  queuePixel(pixel, selected, selected && inFraction(pixel));
}
