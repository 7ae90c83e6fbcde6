// Where the rasterizer draws a point for the camera of the frame: reversed depth in 0..1.
#include "lib/frame.glsl"

vec4 projected(vec3 position) {
  // Relative to the eye before the rotation: exact even if the scene is much larger than what is seen.
  vec3 relative = position - frame.eye;
  float w = dot(relative, frame.forward);
  float near = frame.drawnNear, far = frame.farPlane;
  float z = far > 0.0 ? near * (far - w) / (far - near) : near;
  vec2 screen = vec2(dot(relative, frame.right) / dot(frame.right, frame.right),
                     dot(relative, frame.up) / dot(frame.up, frame.up));
  // The rasterizer looks at pixel centers: samples come to lie there.
  if (frame.parallel != 0u) return vec4(screen - sampleShift(), (far - w) / (far - near), 1.0);
  return vec4(screen - sampleShift() * w, z, w);
}
