// Rays from a surface to direct lights, each with the light that it brings if nothing is in its way.
#include "effects/common/send_on.glsl"
#include "lib/light_sample.glsl"
#include "lib/random.glsl"
#ifdef SHADOW_MARKS
#include "lib/shadow_marks.glsl"
#endif

uniform uint firstLight;  // of those that this dispatch is about
uniform uint lightCount;
uniform uint number;  // of the ray to each light; only lights that have an extent get more than one

// `throughput`: of light that the surface scatters towards the eye. `purpose` chooses the random numbers.
void sendToLights(Surface s, vec3 toEye, uint triangle, uint pixel, vec3 throughput, float pathLength, uint purpose) {
  if (s.unlit) return;
  for (uint light = firstLight; light < firstLight + lightCount; ++light) {
#ifdef SHADOW_MARKS
    if (!isMarked(ivec2(pixel % frame.width, pixel / frame.width), light)) continue;
#endif
    int type = int(lightTexel(light, LIGHT_DIRECTION).w);
    bool extended = type == LIGHT_RECTANGLE || type == LIGHT_SPHERE;
    if (!extended && number != 0u) continue;
    uint samples = extended ? frame.shadowSamples : 1u;
    LightSample to = sampleLight(light, s.position,
                                 sample2(pixel, frame.firstPass * samples + number, joined(purpose, light)));
    if (dot(s.geometricNormal, to.toLight) <= 0.0) continue;
    vec3 brings = throughput * shadeBy(s, toEye, to.toLight) * to.light / float(samples);
    if (all(lessThanEqual(brings, vec3(0.0)))) continue;
    sendOn(Ray(s.position, distanceBefore(to), to.toLight, triangle),
           ScatteredPath(brings, pathLength, pixel, RAY_SHADOW, 0u, 0.0));
  }
}
