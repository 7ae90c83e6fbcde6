// Depth only; materials with an alpha test cut their holes.
#ifdef CUT
#include "lib/alpha.glsl"

in vec2 barycentrics;
flat in CutTriangle cut;

void main() {
  if (cutAway(cut, barycentrics)) discard;
}
#else
void main() {}
#endif
