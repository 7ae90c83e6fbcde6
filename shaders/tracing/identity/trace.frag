// The queue as a raster of `rowLength` rays per row, a fragment per ray.
#include "tracing/common/ray_queue.glsl"
#include "tracing/identity/search.glsl"

uniform uint rowLength;
bool taken = false;

bool takeRay(out uint index) {
  uvec2 texel = uvec2(gl_FragCoord.xy);
  uint number = texel.y * rowLength + texel.x;
  bool some = !taken && number < raysToTrace();
  taken = true;
  index = some ? rayToTrace(number) : 0u;
  return some;
}

void main() { traceRays(); }
