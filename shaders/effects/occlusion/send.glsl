// A ray of ambient occlusion, in directions as often as the cosine says, so that each counts the same.
#include "effects/common/send_on.glsl"
#include "lib/frame.glsl"
#include "lib/random.glsl"
#include "lib/sampling.glsl"

uniform uint firstSample;  // of this pass

// normal: the surface's; geometric: its triangle's, towards the viewer.
void sendOcclusionRay(vec3 position, vec3 normal, vec3 geometric, uint triangle, float pathLength, uint pixel,
                      uint sampleNumber) {
  vec3 direction = cosineDirection(normal, sample2(pixel, firstSample + sampleNumber, 0u));
  // An interpolated normal's hemisphere reaches below the triangle's plane, where the surface would hide itself.
  if (dot(direction, geometric) < 0.0) direction = reflect(direction, geometric);
  sendOn(Ray(position, frame.occlusionRadius, direction, triangle),
         ScatteredPath(vec3(1.0), pathLength, pixel, RAY_OCCLUSION | sampleNumber << 8, 0u, 0.0));
}
