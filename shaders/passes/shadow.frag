// Depth only; materials with an alpha test cut their holes.
#ifdef CUT
#include "lib/alpha.glsl"

in vec2 barycentrics;
flat in uint triangle;

void main() {
  if (cutAway(triangle, barycentrics)) discard;
}
#else
void main() {}
#endif
