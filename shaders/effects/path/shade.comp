// A stretch of a path: what the ray found shines, is lit by one light that is chosen, and sends the path on.
// With CAMERA_HITS rays are the camera's and begin all samples of a pass; with LAST_GENERATION nothing is sent on.
#include "effects/common/light_sums.glsl"
#include "effects/path/choose_light.glsl"
#include "lib/bsdf.glsl"
#include "lib/evaluate_surface.glsl"
#include "lib/queued_ray.glsl"
#include "lib/scene.glsl"
#include "lib/triangle_point.glsl"
#ifndef LAST_GENERATION
#include "effects/common/send_on.glsl"
#endif

layout(local_size_x = 64) in;

#ifndef CAMERA_HITS
layout(std430, binding = SSBO_PATHS) readonly buffer PathBlock { ScatteredPath paths[]; };
#endif
layout(std430, binding = SSBO_RAY_COUNT) readonly buffer RayCountBlock { RayCount rayCount; };
layout(std430, binding = SSBO_HITS) readonly buffer HitBlock { Hit hits[]; };

uniform uint generation;
uniform uint bounces;      // after which a path ends, the camera's surface not counted
uniform uint firstSample;  // of the pass

const uint FIRST_END = 3u;  // generation from which paths may end by chance

// Purposes of random numbers, in each generation.
const uint CHOOSE_LOBE = 0u, CHOOSE_DIRECTION = 1u, CHOOSE_LIGHT = 2u, CHOOSE_POINT = 3u, CHOOSE_END = 4u;
const uint CHOOSE_COVERED = 5u, PURPOSES = 6u;

// ScatteredPath::kindAndSample: the sample's number, and how many surfaces that blend the path has passed.
uint kindAndSample(uint kind, uint sampleNumber, uint passed) { return kind | sampleNumber << 8 | passed << 16; }
uint kindOf(ScatteredPath path) { return path.kindAndSample & 255u; }
uint sampleOf(ScatteredPath path) { return bitfieldExtract(path.kindAndSample, 8, 8); }
uint passedOf(ScatteredPath path) { return path.kindAndSample >> 16; }

vec2 numbersFor(uint purpose, uint pixel, uint sampleNumber) {
  return sample2(pixel, firstSample + sampleNumber, generation * PURPOSES + purpose);
}

// Weight of one of two ways to the same light (Veach & Guibas 1995, the power heuristic). A density of 0 is a way that
// the other cannot take.
float wayWeight(float own, float other) {
  return own <= 0.0 ? 1.0 : 1.0 / (1.0 + (other / own) * (other / own));
}

#ifndef LAST_GENERATION
// The same way on, behind a surface that blends. Light that a path may find both ways is left to the rays to it once
// there is such a surface between: how far it is from where the path was scattered is not known here any more.
void passOn(vec3 position, vec3 direction, float maxDistance, uint triangle, ScatteredPath path, uint kind,
            uint sampleNumber) {
  path.kindAndSample = kindAndSample(kind, sampleNumber, passedOf(path) + 1u);
  sendOn(Ray(position, maxDistance, direction, triangle), path);
}

// What the surface sends on: a ray to a light and the path's next stretch.
void sendFrom(Surface s, Bsdf bsdf, ScatteredPath path, uint sampleNumber, uint triangle, bool front) {
  vec3 throughput = path.throughput;
  uint passed = passedOf(path);
  if (kindsOfLight() > 0.0) {
    LightChoice light = chooseLight(s.position, numbersFor(CHOOSE_LIGHT, path.pixel, sampleNumber),
                                    numbersFor(CHOOSE_POINT, path.pixel, sampleNumber));
    float density;
    vec3 value = evaluateBsdf(bsdf, s, light.direction, density);
    float weight = wayWeight(light.density, density);
    vec3 brought = throughput * value * light.light * weight;
    if (luminance(brought) > 0.0)
      sendOn(Ray(s.position, light.distance, light.direction, triangle),
             ScatteredPath(brought, path.pathLength, path.pixel, kindAndSample(RAY_SHADOW, sampleNumber, passed),
                           light.emitter, weight));
  }
  float eta = front || s.thin ? s.ior : 1.0 / s.ior;
  Scattering next = scatter(bsdf, s, eta, numbersFor(CHOOSE_DIRECTION, path.pixel, sampleNumber),
                            numbersFor(CHOOSE_LOBE, path.pixel, sampleNumber));
  throughput *= next.weight;
  if (frame.roulette != 0u && generation >= FIRST_END) {
    float stay = clamp(max(throughput.r, max(throughput.g, throughput.b)), 0.05, 1.0);
    if (numbersFor(CHOOSE_END, path.pixel, sampleNumber).x >= stay) return;
    throughput /= stay;
  }
  if (luminance(throughput) <= 0.0) return;
  uint media = path.media;
  if (next.passes && !s.thin) media = front ? triangleAt(triangle).w + 1u : 0u;
  sendOn(Ray(s.position, FAR_AWAY, next.direction, triangle),
         ScatteredPath(throughput, path.pathLength, path.pixel, kindAndSample(RAY_SCATTERED, sampleNumber, passed),
                       media, next.density));
}

// A surface that blends is there as often as its alpha says; otherwise the path goes on behind it.
void goOn(Surface s, Bsdf bsdf, ScatteredPath path, vec3 found, vec3 direction, uint sampleNumber, uint triangle,
          bool front, bool ends) {
  if (s.alpha < 1.0 && numbersFor(CHOOSE_COVERED, path.pixel, sampleNumber).x >= s.alpha) {
    passOn(s.position, direction, FAR_AWAY, triangle, path, RAY_THROUGH, sampleNumber);
    return;
  }
  addLight(path.pixel, found);
  if (!s.unlit && !ends) sendFrom(s, bsdf, path, sampleNumber, triangle, front);
}
#endif

bool blendsAt(uint triangle) {
  return frame.blends != 0u && (materials[triangleAt(triangle).w].flags & MATERIAL_BLEND) != 0u;
}

void main() {
  uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
  if (index >= rayCount.count) return;
#ifdef CAMERA_HITS
  Ray ray = cameraRay(pixelOfRay(index));
  ScatteredPath path = ScatteredPath(vec3(1.0), 0.0, pixelOfRay(index), RAY_SCATTERED, 0u, 0.0);
#else
  Ray ray = queuedRay(index, RAYS_STORED);
  ScatteredPath path = paths[index];
#endif
  Hit hit = hits[index];
  uint kind = kindOf(path), sampleNumber = sampleOf(path);
  if (hit.triangle == NO_TRIANGLE && hit.t != HIT_MISS) return;  // given up, and counted
  if (hit.triangle == NO_TRIANGLE) {
    if (kind == RAY_SHADOW && path.media == 0u) addLight(path.pixel, path.throughput);
    if (kind == RAY_SHADOW || skyShines == 0u) return;
    float weight = wayWeight(path.density, path.density > 0.0 ? skyDensity(ray.direction) : 0.0);
    addLight(path.pixel, path.throughput * weight * skyRadiance(ray.direction, 0.0));
    return;
  }
  if (kind == RAY_SHADOW && hit.triangle + 1u != path.media && !blendsAt(hit.triangle)) return;

  // The method says which triangle it is, and all methods then see the same point of it.
  TrianglePoint point = pointOnTriangle(hit.triangle, ray.origin, ray.direction);
  float distance = dot(point.relative, ray.direction), pathLength = path.pathLength + distance;
  Surface s = evaluateSurface(hit.triangle, point.barycentrics, ray.direction, coneWidth(pathLength),
                              ALL_TEXTURES);
  s.position = point.position;
  if (frame.blends == 0u) s.alpha = 1.0;
  vec3 shines = s.unlit ? s.baseColor : s.emissive;
  if (kind == RAY_SHADOW) {
    if (hit.triangle + 1u == path.media) {
      addLight(path.pixel, path.throughput * shines * s.alpha);
      return;
    }
#ifndef LAST_GENERATION
    path.throughput *= 1.0 - s.alpha;
    if (path.media != 0u) {
      path.throughput /= path.density;
      path.density = 1.0;
    }
    path.pathLength = pathLength;
    float left = ray.maxDistance < FAR_AWAY ? ray.maxDistance - distance : FAR_AWAY;
    if (s.alpha < 1.0) passOn(s.position, ray.direction, left, hit.triangle, path, RAY_SHADOW, sampleNumber);
#endif
    return;
  }
  vec3 throughput = path.throughput;
  if (path.media != 0u) throughput *= exp(-materials[path.media - 1u].absorption * distance);
  float weight = 1.0;
  if (path.density > 0.0 && !s.unlit && luminance(shines) > 0.0) {
    float other = emitterDensity(hit.triangle, ray.direction, distance);
    weight = kind == RAY_THROUGH && other > 0.0 ? 0.0 : wayWeight(path.density, other);
  }
  vec3 found = throughput * weight * shines;
#ifdef LAST_GENERATION
  addLight(path.pixel, found * s.alpha);
#else
  path.throughput = throughput;
  path.pathLength = pathLength;
  vec3 a, b, c;
  trianglePositions(hit.triangle, a, b, c);
  bool front = dot(cross(b - a, c - a), ray.direction) < 0.0;
  Bsdf bsdf = makeBsdf(s, -ray.direction);
  bool ends = generation > bounces + passedOf(path);
#ifdef CAMERA_HITS
  for (uint i = 0u; i < frame.effectSamples; ++i) goOn(s, bsdf, path, found, ray.direction, i, hit.triangle, front, ends);
#else
  goOn(s, bsdf, path, found, ray.direction, sampleNumber, hit.triangle, front, ends);
#endif
#endif
}
