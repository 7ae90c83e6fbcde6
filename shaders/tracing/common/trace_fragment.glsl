// The queue as a raster of `rowLength` rays per row.
#include "tracing/common/trace_ray.glsl"

uniform uint rowLength;

void main() {
  uvec2 texel = uvec2(gl_FragCoord.xy);
  uint number = texel.y * rowLength + texel.x;
  if (number < raysToTrace()) traceRay(number);
}
