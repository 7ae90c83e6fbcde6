// Search of the layered depth cube (Buerger et al. 2007, section 1.4): axis by axis, through blocks whose range of
// depths the ray meets and through their texels. A sample is hit if the ray comes within the tolerance of its depth
// while it passes the texel; the hit is put on the sample's plane. A hit on one axis shortens the ray for the next
// ones, and the nearest is left.
#include "lib/scene.glsl"
#include "shared/passes/trace.h"
#include "shared/rays.h"
#include "shared/structs.h"
#include "tracing/common/ray_work.glsl"
#include "tracing/common/trace_state.glsl"
#include "tracing/depth_cube/cube.glsl"
#include "tracing/depth_cube/walk.glsl"

layout(binding = UNIT_CUBE_DEPTHS) uniform sampler2DArray cubeDepths;
layout(binding = UNIT_CUBE_NORMALS) uniform usampler2DArray cubeNormals;
layout(binding = UNIT_CUBE_TRIANGLES) uniform usampler2DArray cubeTriangles;
layout(binding = UNIT_CUBE_COLORS) uniform sampler2DArray cubeColors;
layout(std430, binding = SSBO_CUBE_BLOCKS) readonly buffer BlockBlock { vec2 blockDepths[]; };
layout(std430, binding = SSBO_CUBE_COUNTS) readonly buffer CountBlock { uint sampleCounts[]; };
layout(std430, binding = SSBO_HIT_SURFACES) writeonly buffer HitSurfaceBlock { HitSurface hitSurfaces[]; };
uniform int layerCount;
uniform int samplesLost;  // 1: texels may have more samples than layers
uniform float tolerance;  // meters
uniform float texelSize;  // meters
uniform int planes;       // 1: hits lie on their sample's plane

const uint noSample = 0xffffffffu;
// Farther along the ray, in texels, a sample says nothing of its surface.
const float planeReach = 32.0;
uint found = noSample;

// A sample's number: layer, then place.
uint sampleNumber(ivec3 place) {
  return (uint(place.z) * uint(bufferResolution) + uint(place.y)) * uint(3 * bufferResolution) + uint(place.x);
}
ivec3 samplePlace(uint number) {
  uint width = uint(3 * bufferResolution), row = number / width;
  return ivec3(number % width, row % uint(bufferResolution), row / uint(bufferResolution));
}

float depthTolerance(int axis) { return tolerance * gridInverse[axis]; }

// Where the ray passes the sample's depth, or comes nearest to it within its texel.
float sampleDistance(TraceRay ray, ivec3 place, float end) {
  int axis = axisOfTexel(place.xy);
  vec3 origin = permute(ray.gridOrigin, axis), direction = permute(ray.gridDirection, axis);
  vec2 range = vec2(0.0, end);
  ivec2 texel = place.xy - cubeTexel(axis, ivec2(0));
  for (int i = 0; i < 2; ++i) {
    if (direction[i] == 0.0) continue;
    float a = (float(texel[i]) / float(bufferResolution) - origin[i]) / direction[i];
    float b = (float(texel[i] + 1) / float(bufferResolution) - origin[i]) / direction[i];
    range = vec2(max(range.x, min(a, b)), min(range.y, max(a, b)));
  }
  if (direction.z == 0.0) return 0.5 * (range.x + range.y);
  return clamp((texelFetch(cubeDepths, place, 0).x - origin.z) / direction.z, range.x, max(range.x, range.y));
}

vec3 positionOf(ivec3 place) {
  int axis = axisOfTexel(place.xy);
  vec2 texel = (vec2(place.xy - cubeTexel(axis, ivec2(0))) + 0.5) / float(bufferResolution);
  return gridLow + unpermute(vec3(texel, texelFetch(cubeDepths, place, 0).x), axis) / gridInverse;
}

// Whether a sample is of a surface that the ray may hit. Within the tolerance a ray meets the surface that it leaves,
// the longer the flatter it leaves it: those do not count on whose plane the ray starts, as well as that is known.
bool counts(TraceRay ray, vec3 normal, float fromPlane, uint triangle, float t, float crossing) {
  bool facing = dot(normal, ray.direction) <= 0.0 || doubleSided(triangleAt(triangle).w);
  bool leaving = min(t, crossing) <= 4.0 * texelSize && abs(fromPlane) <= tolerance + 0.5 * texelSize;
  return facing && !leaving && triangle != ray.excluded;
}

// It depends on ray and sample alone, so that a ray that was paused finds its hit again.
void testSample(TraceRay ray, ivec3 place, float end, inout Hit best) {
  float t = sampleDistance(ray, place, end);
  uint triangle = texelFetch(cubeTriangles, place, 0).x;
  vec3 normal = unpackUnit(texelFetch(cubeNormals, place, 0).x);
  float fromPlane = dot(normal, positionOf(place) - ray.origin);
  float crossing = fromPlane / dot(normal, ray.direction);
  bool counted = counts(ray, normal, fromPlane, triangle, t, crossing);
  if (planes == 1 && abs(crossing - t) <= planeReach * texelSize) t = crossing;
  bool nearer = t < best.t || (t == best.t && triangle < best.triangle);
  if (t < ray.least || t > end || !nearer || !counted) return;
  best = Hit(t, triangle, 0.0, 0.0);
  found = sampleNumber(place);
}

// False if the ray is not through; `pause` then says how to go on: where on which axis, with which sample found.
//
// Each turn of the inner loop looks at one block or one depth; a lane whose sample may be a hit leaves it and is dealt
// with behind it (see tracing/README.md).
bool march(TraceRay ray, float end, inout PausedRay pause, inout Hit best) {
  float start = gridRange(ray).x;
  float lost = pause.own == 0u ? farAway : uintBitsToFloat(pause.own);  // where samples may be missing
  if (pause.bestTriangle > 0u) testSample(ray, samplePlace(pause.bestTriangle - 1u), end, best);
  CubeWalk walk = startCubeWalk(ray, int(pause.tested), pause.t);
  int layer = 0;
  int candidate = -1;  // layer of a sample that may be a hit
  int work = 0;
  bool going = walk.t < end, yielded = false;
  while (going) {
    while (going && candidate < 0 && work < workLimit) {
      float last = min(end, best.t);
      float exit = min(cubeExit(walk), last);
      float slack = depthTolerance(walk.axis);
      vec2 passed = walk.origin.z + walk.direction.z * vec2(walk.t, exit);
      // Whatever the slack, the end of a texel's samples is out of reach.
      float low = min(passed.x, passed.y) - slack, high = min(max(passed.x, passed.y) + slack, 0.75 * CUBE_NO_SAMPLE);
      bool onward;
      if (walk.inBlock) {
        float depth = CUBE_NO_SAMPLE;
        countTest();
        if (layer < layerCount) depth = texelFetch(cubeDepths, ivec3(cubeTexel(walk.axis, walk.cell), layer), 0).x;
        if (depth >= low && depth <= high) candidate = layer;
        onward = depth > high;
        if (samplesLost == 1 && layer == layerCount && sampleCounts[headIndex(walk.axis, walk.cell)] > uint(layerCount))
          lost = min(lost, max(walk.t, 1e-30));
        ++layer;
      } else {
        countStep();
        vec2 range = blockDepths[blockIndex(walk.axis, walk.cell)];
        onward = low > range.y || high < range.x;
        if (!onward) enterBlock(walk);
        layer = 0;
      }
      if (onward) {
        layer = 0;
        bool more = exit < last && stepCubeWalk(walk);
        if (!more) {
          going = walk.axis < 2;
          walk = startCubeWalk(ray, min(walk.axis + 1, 2), start);
        }
      }
      ++work;
    }
    if (candidate >= 0) testSample(ray, ivec3(cubeTexel(walk.axis, walk.cell), candidate), end, best);
    candidate = -1;
    if (going && work >= workLimit) {
      yielded = true;
      going = false;
    }
  }
  incomplete = !yielded && lost < best.t;
  pause = PausedRay(walk.t, found == noSample ? 0u : found + 1u, uint(walk.axis),
                    lost == farAway ? 0u : floatBitsToUint(lost));
  return !yielded;
}

void storeSurface(uint index, Hit hit) {
  HitSurface surface = HitSurface(vec3(0.0), 0.0, vec3(0.0), 0.0);
  if (hit.t >= 0.0) {
    ivec3 place = samplePlace(found);
    vec4 color = texelFetch(cubeColors, place, 0);
    surface.baseColor = color.rgb * color.rgb;
    surface.reflectivity = color.a * color.a;
    surface.normal = unpackUnit(texelFetch(cubeNormals, place, 0).x);
  }
  hitSurfaces[index] = surface;
}
