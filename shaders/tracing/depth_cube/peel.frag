// One layer of all three images: of the fragments behind the layer before, the depth test keeps the nearest (Everitt
// 2001). A fragment's depth is one number in all passes, so that none comes twice. Compiled with CUT for materials with
// holes.
#ifdef CUT
#include "lib/alpha.glsl"
#include "lib/scene.glsl"
#endif
#include "shared/passes/depth_cube.h"

layout(binding = UNIT_CUBE_PREVIOUS) uniform sampler2D previousDepths;

layout(location = 0) flat in uint inTriangle;
layout(location = 1) in vec3 inBarycentricsDepth;
layout(location = 0) out float outDepth;
layout(location = 1) out uint outTriangle;

void main() {
  float depth = inBarycentricsDepth.z;
  if (depth <= texelFetch(previousDepths, ivec2(gl_FragCoord.xy), 0).x) discard;
#ifdef CUT
  if (cutAway(inTriangle, inBarycentricsDepth.xy)) discard;
#endif
  gl_FragDepth = depth;
  outDepth = depth;
  outTriangle = inTriangle;
}
