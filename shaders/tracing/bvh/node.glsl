// A ray against a node's four boxes at once (Ylitie, Karras & Laine 2017 for the quantized boxes of a wide node).
#include "shared/passes/bvh.h"
#include "tracing/common/walk.glsl"

layout(std430, binding = SSBO_BVH_NODES) readonly buffer BvhNodeBlock { BvhNode bvhNodes[]; };
layout(std430, binding = SSBO_BVH_TRIANGLES) readonly buffer BvhTriangleBlock { uint bvhTriangles[]; };

struct BoxRay {
  vec3 origin, inverse;
  float low, high;  // parameters
};

BoxRay makeBoxRay(TraceRay ray, float low, float high) {
  // No infinities: 0 times one is no number.
  vec3 size = max(abs(ray.direction), vec3(1e-30));
  return BoxRay(ray.origin, mix(1.0 / size, -1.0 / size, lessThan(ray.direction, vec3(0.0))), low, high);
}

vec4 bytesOf(uint word) { return vec4((uvec4(word) >> uvec4(0u, 8u, 16u, 24u)) & 255u); }

// Distances to the entries and exits of four boxes along one axis.
void crossSlabs(uint low, uint high, float start, float scale, float origin, float inverse, inout vec4 entry,
                inout vec4 exit) {
  bool backward = inverse < 0.0;
  vec4 near = (start + bytesOf(backward ? high : low) * scale - origin) * inverse;
  vec4 far = (start + bytesOf(backward ? low : high) * scale - origin) * inverse;
  entry = max(entry, near);
  exit = min(exit, far);
}

float stepOf(uint exponents, int axis) { return uintBitsToFloat((exponents >> (8 * axis) & 255u) << 23); }

struct Children {
  uvec4 words;  // by distance; BVH_NO_CHILD for those that the ray misses, which come last
  vec4 near;
};

void order(inout Children c, int i, int j) {
  bool swapped = c.near[j] < c.near[i];
  float near = swapped ? c.near[i] : c.near[j];
  uint word = swapped ? c.words[i] : c.words[j];
  c.near[i] = swapped ? c.near[j] : c.near[i];
  c.words[i] = swapped ? c.words[j] : c.words[i];
  c.near[j] = near;
  c.words[j] = word;
}

// The children that the ray passes, nearest first. What is farther than a hit is left out by the caller, so that the
// order depends on the ray and the node alone.
Children childrenOf(BoxRay ray, uint number) {
  BvhNode node = bvhNodes[number];
  vec4 entry = vec4(ray.low), exit = vec4(ray.high);
  crossSlabs(node.low[0], node.high[0], node.origin.x, stepOf(node.exponents, 0), ray.origin.x, ray.inverse.x, entry,
             exit);
  crossSlabs(node.low[1], node.high[1], node.origin.y, stepOf(node.exponents, 1), ray.origin.y, ray.inverse.y, entry,
             exit);
  crossSlabs(node.low[2], node.high[2], node.origin.z, stepOf(node.exponents, 2), ray.origin.z, ray.inverse.z, entry,
             exit);
  uvec4 words = uvec4(node.children[0], node.children[1], node.children[2], node.children[3]);
  // Each distance is off by three roundings (Ize 2013).
  const float slack = 1.0000005;
  bvec4 missed = greaterThan(entry, exit * slack);
  Children c;
  c.words = mix(words, uvec4(BVH_NO_CHILD), missed);
  c.near = mix(entry, vec4(farAway), equal(c.words, uvec4(BVH_NO_CHILD)));
  order(c, 0, 2);
  order(c, 1, 3);
  order(c, 0, 1);
  order(c, 2, 3);
  order(c, 1, 2);
  return c;
}
