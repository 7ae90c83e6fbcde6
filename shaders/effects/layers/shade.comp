// One layer of what lies behind a pixel: the light that its surface adds, and the ray that goes on behind it.
// With CAMERA_HITS rays are the camera's; with LAST_GENERATION the sky follows on the layer; with XRAY surfaces absorb
// and glow instead of being lit; with REFLECTIONS rays go on from what reflects, too.
#include "effects/common/light_sums.glsl"
#include "lib/evaluate_surface.glsl"
#include "lib/lights.glsl"
#include "lib/queued_ray.glsl"
#include "lib/scene.glsl"
#include "lib/sky.glsl"
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

// What a surface adds to the light behind it and how much of that it lets through.
struct Layer {
  vec3 light;
  float passes;
};

#ifdef XRAY
// A skin of even thickness: at a slant the way through it is 1 / cosine as long.
Layer layerOf(uint triangle, TrianglePoint point, vec3 direction, ScatteredPath path) {
  const vec3 GLOW = vec3(0.62, 0.78, 1.0);
  uvec4 corners = triangleAt(triangle);
  vec3 normal = mat3(attributes[corners.x].normal, attributes[corners.y].normal, attributes[corners.z].normal) *
                vec3(1.0 - point.barycentrics.x - point.barycentrics.y, point.barycentrics);
  float cosine = dot(normal, normal) > 0.0 ? abs(dot(normalize(normal), direction)) : 1.0;
  float passes = pow(1.0 - frame.layerOpacity, 1.0 / max(cosine, 1e-3));
  return Layer((1.0 - passes) * GLOW, passes);
}
#else
// The light of a pixel as the composite pass blends it. Of what it reflects the sky is left out if a ray finds it.
vec3 lightOf(Surface s, vec3 direction, bool traced) {
  vec4 lit = directLighting(s, -direction);
  if (s.unlit) return lit.rgb;
  float cosine = -dot(s.normal, direction);
  vec3 share = reflectionShare(s.f0, s.roughness, cosine);
  vec3 sky = skyRadiance(reflect(direction, s.normal), s.roughness) * lit.a;
  return (1.0 - share) * lit.rgb + ((traced ? vec3(0.0) : share) + skyShare(s.f0, s.roughness, cosine)) * sky;
}

Layer layerOf(uint triangle, TrianglePoint point, vec3 direction, ScatteredPath path) {
  Surface s = evaluateSurface(triangle, point.barycentrics, direction, coneWidth(path.pathLength),
                              BASE_TEXTURES);
  s.position = point.position;
  float covers = frame.layerOpacity * s.alpha;
  bool traced = false;
#if defined(REFLECTIONS) && !defined(LAST_GENERATION)
  traced = s.reflectivity > frame.minReflectivity && path.media < frame.bounces;  // media counts reflections
  if (traced) {
    path.throughput *= covers * reflectionShare(s.f0, s.roughness, -dot(s.normal, direction));
    path.kindAndSample = RAY_REFLECTION;
    ++path.media;
    sendOn(Ray(s.position, FAR_AWAY, reflect(direction, s.normal), triangle), path);
  }
#endif
  return Layer(covers * lightOf(s, direction, traced), 1.0 - covers);
}
#endif

void main() {
  uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
  if (index >= rayCount.count) return;
#ifdef CAMERA_HITS
  Ray ray = cameraRay(pixelOfRay(index));
  ScatteredPath path = ScatteredPath(vec3(1.0), 0.0, pixelOfRay(index), RAY_THROUGH, 0u, 0.0);
#else
  Ray ray = queuedRay(index, RAYS_STORED);
  ScatteredPath path = paths[index];
#endif
  Hit hit = hits[index];
  if (hit.triangle == NO_TRIANGLE) {
    // A ray that was given up is counted, and shows the sky as well.
    addLight(path.pixel, path.throughput * skyRadiance(ray.direction, 0.0));
    return;
  }
  // The method says which triangle it is, and all methods then see the same point of it.
  TrianglePoint point = pointOnTriangle(hit.triangle, ray.origin, ray.direction);
  path.pathLength += dot(point.relative, ray.direction);
  Layer layer = layerOf(hit.triangle, point, ray.direction, path);
  vec3 light = path.throughput * layer.light;
  path.throughput *= layer.passes;
#ifdef LAST_GENERATION
  light += path.throughput * skyRadiance(ray.direction, 0.0);
#else
  path.kindAndSample = RAY_THROUGH;
  if (layer.passes > 0.0) sendOn(Ray(point.position, FAR_AWAY, ray.direction, hit.triangle), path);
#endif
  addLight(path.pixel, light);
}
