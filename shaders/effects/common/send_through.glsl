// Rays that a meeting sends on, and those to lights that go on behind what is clear.
#include "effects/common/meeting.glsl"
#include "effects/common/send_on.glsl"
#include "lib/random.glsl"

// A way of a path gives it another number.
uint pathVia(Meeting m, uint way) { return joined(m.path, way) & 0xffffffu; }
const uint WAY_REFLECTED = 0u, WAY_THROUGH = 1u, WAY_COAT = 4u, WAY_TO_LIGHT = 5u, WAY_BEHIND = 6u;

void sendRay(Meeting m, uint kind, uint way, vec3 direction, float maxDistance, vec3 throughput, uint media) {
  sendOn(Ray(m.s.position, maxDistance, direction, m.triangle),
         ScatteredPath(throughput, m.pathLength, m.pixel, kind | pathVia(m, way) << 8, media, 0.0));
}

// A ray to a light goes on straight behind a clear surface. The border reflects the same from both sides: a ray that is
// not bent meets no total reflection.
void sendThrough(Meeting m, Ray ray) {
  float ratio = indexRatio(m, 1);
  float reflectance = meetInterface(m.direction, m.s.normal, min(ratio, 1.0 / ratio)).reflectance;
  vec3 clear = m.s.baseColor * (clearShare(m.s) * (1.0 - reflectance) * (1.0 - coatReflectance(m)));
  float covers = frame.blends != 0u ? m.s.alpha : 1.0;
  vec3 throughput = m.throughput * (covers * clear + (1.0 - covers));
  float maxDistance = ray.maxDistance < FAR_AWAY ? ray.maxDistance - m.distance : FAR_AWAY;
  if (any(greaterThan(throughput, vec3(0.0))))
    sendRay(m, RAY_SHADOW, WAY_TO_LIGHT, m.direction, maxDistance, throughput, m.behind);
}
