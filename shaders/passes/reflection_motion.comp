// How far the image in a mirror has moved on the screen: where the mirror showed, in the frame before, the point that a
// pixel's ray has hit. One invocation per first ray.
#include "lib/curved_mirror.glsl"
#include "lib/motion.glsl"
#include "lib/triangle_point.glsl"
#include "lib/queued_ray.glsl"
#include "shared/passes/temporal.h"

layout(local_size_x = 64) in;

layout(std430, binding = SSBO_RAY_COUNT) readonly buffer RayCountBlock { RayCount rayCount; };
layout(std430, binding = SSBO_HITS) readonly buffer HitBlock { Hit hits[]; };

layout(rgba32f, binding = IMAGE_REFLECTION_MOTION) uniform writeonly image2D motionImage;

vec3 normalOf(vec3 a, vec3 b, vec3 c) { return normalize(cross(b - a, c - a)); }

// The shading normal in the frame before: it turns with its triangle.
vec3 normalBefore(uint triangle, vec3 normal) {
  uvec4 corners = triangleAt(triangle);
  vec3 now = normalOf(vertexPosition(corners.x), vertexPosition(corners.y), vertexPosition(corners.z));
  vec3 before = normalOf(previousVertex(corners.x), previousVertex(corners.y), previousVertex(corners.z));
  return normalize(normal + (dot(now, normal) < 0.0 ? now - before : before - now));
}

// Of what is seen through a surface.
vec4 motionBehind(Ray ray, Hit hit) {
  if (hit.triangle == NO_TRIANGLE)
    return vec4(seenAt(ray.direction, frame) - seenAt(ray.direction, previousFrame), vec2(VERY_FAR));
  vec3 hitNow = ray.origin + hit.t * ray.direction, hitBefore = hitNow;
#ifndef HIT_SURFACES
  vec3 now, before;
  pointThenAndNow(hit.triangle, vec2(hit.u, hit.v), now, before);
  hitBefore += before - now;
#endif
  return vec4(motionOf(hitNow, hitBefore), dot(hitNow - frame.eye, frame.forward),
              dot(hitBefore - previousFrame.eye, previousFrame.forward));
}

vec3 mirrored(vec3 point, vec3 onPlane, vec3 normal) { return point - 2.0 * dot(point - onPlane, normal) * normal; }

void main() {
  uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
  if (index >= rayCount.count) return;
  uint number = pixelOfRay(index);
  ivec2 pixel = ivec2(number % frame.width, number / frame.width);
  Ray ray = mirrorRay(number);
  Hit hit = hits[index];
  if (hit.triangle == NO_TRIANGLE && hit.t != HIT_MISS) return;  // given up: it shows the sky's stand-in

  vec4 facing = facingAt(pixel);
  vec3 normal = facing.xyz;
  if (goesOn(facing)) {
    imageStore(motionImage, pixel, motionBehind(ray, hit));
    return;
  }
  vec3 then = normalBefore(ray.excluded, normal);
  vec2 barycentrics = pointOnTriangle(ray.excluded, pixelOrigin(pixel), pixelRay(pixel)).barycentrics;
  vec3 mirrorNow, mirrorBefore;
  pointThenAndNow(ray.excluded, barycentrics, mirrorNow, mirrorBefore);
  vec3 towardsImage = reflect(ray.direction, then);
  bool parallel = frame.parallel != 0u || previousFrame.parallel != 0u;
  vec2 motion = vec2(0.0);
  if (!parallel) motion = seenAt(reflect(ray.direction, normal), frame) - seenAt(towardsImage, previousFrame);
  vec2 depths = vec2(VERY_FAR);
  if (hit.triangle != NO_TRIANGLE) {
    vec3 hitNow = ray.origin + hit.t * ray.direction, hitBefore = hitNow;
#ifndef HIT_SURFACES
    // Methods that store attributes know no place in the triangle.
    vec3 now, before;
    pointThenAndNow(hit.triangle, vec2(hit.u, hit.v), now, before);
    hitBefore += before - now;
#endif
    vec3 imageNow = mirrored(hitNow, mirrorNow, normal), imageBefore = mirrored(hitBefore, mirrorBefore, then);
    motion = motionOf(imageNow, imageBefore);
    towardsImage = imageBefore - previousFrame.eye;
    depths = vec2(dot(imageNow - frame.eye, frame.forward), dot(towardsImage, previousFrame.forward));
  }
  // So far the mirror is flat. If it is not, the ray met it nearer to where it does now.
  Curvature curvature = curvatureOf(ray.excluded, barycentrics, then);
  float approach = dot(towardsImage, then);
  if (!parallel && curvature.any && approach < 0.0) {
    vec3 fromEye = mirrorBefore - previousFrame.eye;
    vec3 flatPlace = dot(fromEye, then) / approach * towardsImage;
    float eyeAndHit = 1.0 / length(fromEye) + (hit.triangle != NO_TRIANGLE ? 1.0 / hit.t : 0.0);
    vec3 place = fromEye + onCurvedMirror(flatPlace - fromEye, normalize(fromEye), then, eyeAndHit, curvature);
    motion += seenAt(flatPlace, previousFrame) - seenAt(place, previousFrame);
  }
  imageStore(motionImage, pixel, vec4(motion, depths));
}
