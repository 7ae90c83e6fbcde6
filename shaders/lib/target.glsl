// For passes that draw over the rectangle of a target (passes/target_draw.h).
#include "lib/gbuffer.glsl"

uniform vec2 origin;  // of the rectangle
#ifdef TARGET_DEPTH
uniform bool reversedDepth;
#endif

layout(location = 0) out vec4 color;

// The pixel of the picture that this fragment is. Gives the fragment its depth, if the target has a use for it.
ivec2 targetPixel() {
  ivec2 pixel = ivec2(gl_FragCoord.xy - origin);
#ifdef TARGET_DEPTH
  float along = drawnDepth(pixel);
  float near = frame.nearPlane, far = frame.farPlane;
  float depth = far > 0.0 ? near * (far - along) / (along * (far - near)) : near / along;
  if (frame.parallel != 0u) depth = (far - along) / (far - near);
  depth = along < FAR_AWAY ? clamp(depth, 0.0, 1.0) : 0.0;  // the sky is far away
  gl_FragDepth = reversedDepth ? depth : 1.0 - depth;
#endif
  return pixel;
}
