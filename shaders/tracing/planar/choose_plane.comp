// How many reflecting samples lie in the plane of each of 64 of them, spread over the screen. One group per candidate.
#include "shared/bindings.h"
#include "shared/passes/captures.h"
#include "tracing/common/capture_samples.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = SSBO_PLANES) buffer PlaneBlock { MirrorPlanes planes; };

shared int first;
shared uint votes;

const int TILES = 8;  // along each side of the screen
const ivec2 TILE = SAMPLES / TILES;

void main() {
  int lane = int(gl_LocalInvocationIndex), tile = int(gl_WorkGroupID.x);
  if (lane == 0) {
    first = SAMPLES.x * SAMPLES.y;
    votes = 0u;
  }
  barrier();
  // The first sample of its tile.
  for (int i = lane; i < TILE.x * TILE.y; i += 64) {
    ivec2 at = TILE * ivec2(tile % TILES, tile / TILES) + ivec2(i % TILE.x, i / TILE.x);
    int number = at.y * SAMPLES.x + at.x;
    if (sampledPixel(number).reflects) atomicMin(first, number);
  }
  barrier();
  if (first == SAMPLES.x * SAMPLES.y) {
    if (lane == 0) planes.votes[tile] = 0u;
    return;
  }
  ReflectingPixel candidate = sampledPixel(first);
  float offset = dot(candidate.normal, candidate.position);
  uint own = 0u;
  for (int i = lane; i < SAMPLES.x * SAMPLES.y; i += 64) {
    ReflectingPixel other = sampledPixel(i);
    bool within = abs(dot(candidate.normal, other.position) - offset) < 1e-4 * frame.diagonal;
    if (other.reflects && within && dot(candidate.normal, other.normal) > 0.9999) ++own;
  }
  atomicAdd(votes, own);
  barrier();
  if (lane != 0) return;
  planes.candidates[tile] = vec4(candidate.normal, -offset);
  planes.votes[tile] = votes;
}
