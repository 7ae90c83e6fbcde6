// Choices among all that shines: lights, emitting triangles and the sky. Each kind that there is is chosen equally
// often; within it lights equally often, triangles and the sky's cells by their brightness.
#include "lib/light_sample.glsl"
#include "lib/random.glsl"
#include "lib/sky.glsl"
#include "lib/triangles.glsl"
#include "shared/passes/path.h"

layout(binding = UNIT_EMITTERS) uniform usamplerBuffer emitters;
layout(binding = UNIT_SKY_TABLE) uniform samplerBuffer skyTable;

uniform uint emitterCount;
uniform uint skyRows;
uniform uint skyColumns;
uniform uint skyShines;

const float FULL_CIRCLE = 6.28318530717959;

float kindsOfLight() { return float(min(frame.directLights, 1u) + min(emitterCount, 1u) + skyShines); }

// A ray towards light and what it brings if it gets there.
struct LightChoice {
  vec3 direction;
  float distance;
  vec3 light;      // irradiance per chance, or 1 per density of an emitter, whose light the ray finds itself
  float density;   // per solid angle; 0: nothing but choosing finds this light
  uint emitter;    // triangle + 1; 0: the light comes if nothing is in the way
};

float emitterSum(uint entry) { return uintBitsToFloat(texelFetch(emitters, int(entry)).y); }
float emitterChance(uint entry) { return emitterSum(entry) - (entry == 0u ? 0.0 : emitterSum(entry - 1u)); }

// The first of `count` sums from `first` on that is above the number.
uint chooseInSky(uint first, uint count, float number) {
  uint low = 0u, high = count - 1u;
  while (low < high) {
    uint middle = (low + high) / 2u;
    if (texelFetch(skyTable, int(first + middle)).x > number)
      high = middle;
    else
      low = middle + 1u;
  }
  return low;
}

vec2 skySums(uint first, uint place) {  // before it, and with it
  float before = place == 0u ? 0.0 : texelFetch(skyTable, int(first + place - 1u)).x;
  return vec2(before, texelFetch(skyTable, int(first + place)).x);
}

uint skyRowStart(uint row) { return skyRows + row * skyColumns; }

// Density of choosing a direction of the sky, per solid angle.
float skyDensity(vec3 direction) {
  uint row = min(uint(0.5 * (1.0 - direction.y) * float(skyRows)), skyRows - 1u);
  float turn = 0.5 + atan(direction.x, -direction.z) / FULL_CIRCLE;
  uint column = min(uint(turn * float(skyColumns)), skyColumns - 1u);
  vec2 rowSums = skySums(0u, row), sums = skySums(skyRowStart(row), column);
  float chance = (rowSums.y - rowSums.x) * (sums.y - sums.x);
  return chance * float(skyRows * skyColumns) / (2.0 * FULL_CIRCLE * kindsOfLight());
}

// Density of choosing the point of an emitter that a ray has found.
float emitterDensity(uint triangle, vec3 direction, float distance) {
  if (emitterCount == 0u) return 0.0;
  uint low = 0u, high = emitterCount - 1u;
  while (low < high) {
    uint middle = (low + high) / 2u;
    if (texelFetch(emitters, int(middle)).x >= triangle)
      high = middle;
    else
      low = middle + 1u;
  }
  if (texelFetch(emitters, int(low)).x != triangle) return 0.0;
  vec3 a, b, c;
  trianglePositions(triangle, a, b, c);
  // Of the area, seen at its angle.
  float seen = 0.5 * abs(dot(cross(b - a, c - a), direction));
  return emitterChance(low) * distance * distance / max(seen * kindsOfLight(), 1e-30);
}

LightChoice chooseSky(vec2 numbers) {
  uint row = chooseInSky(0u, skyRows, numbers.x);
  vec2 rowSums = skySums(0u, row);
  uint column = chooseInSky(skyRowStart(row), skyColumns, numbers.y);
  vec2 sums = skySums(skyRowStart(row), column);
  // What is left of the numbers chooses within the cell.
  vec2 left = clamp((numbers - vec2(rowSums.x, sums.x)) / max(vec2(rowSums.y - rowSums.x, sums.y - sums.x), 1e-9), 0.0,
                    0.9999999);
  float up = 1.0 - 2.0 * (float(row) + left.x) / float(skyRows);
  float angle = FULL_CIRCLE * ((float(column) + left.y) / float(skyColumns) - 0.5);
  float across = sqrt(max(0.0, 1.0 - up * up));
  vec3 direction = vec3(across * sin(angle), up, -across * cos(angle));
  float density = skyDensity(direction);
  return LightChoice(direction, FAR_AWAY, skyRadiance(direction, 0.0) / max(density, 1e-30), density, 0u);
}

LightChoice chooseEmitter(vec3 position, float number, vec2 numbers) {
  uint low = 0u, high = emitterCount - 1u;
  while (low < high) {
    uint middle = (low + high) / 2u;
    if (emitterSum(middle) > number)
      high = middle;
    else
      low = middle + 1u;
  }
  uint triangle = texelFetch(emitters, int(low)).x;
  vec3 a, b, c;
  trianglePositions(triangle, a, b, c);
  float root = sqrt(numbers.x);
  vec3 toLight = a + root * ((1.0 - numbers.y) * (b - a) + numbers.y * (c - a)) - position;
  float distance = length(toLight);
  vec3 direction = toLight / max(distance, 1e-30);
  float density = emitterDensity(triangle, direction, distance);
  vec3 light = density > 0.0 ? vec3(1.0 / density) : vec3(0.0);
  return LightChoice(direction, FAR_AWAY, light, density, triangle + 1u);
}

LightChoice chooseDirect(vec3 position, float number, vec2 numbers) {
  uint light = min(uint(number * float(frame.directLights)), frame.directLights - 1u);
  LightSample chosen = sampleLight(light, position, numbers);
  float chance = 1.0 / (kindsOfLight() * float(frame.directLights));
  return LightChoice(chosen.toLight, chosen.distance, chosen.light / chance, 0.0, 0u);
}

LightChoice chooseLight(vec3 position, vec2 choices, vec2 numbers) {
  float kind = choices.x * kindsOfLight();
  if (frame.directLights > 0u) {
    if (kind < 1.0) return chooseDirect(position, choices.y, numbers);
    kind -= 1.0;
  }
  if (emitterCount > 0u) {
    if (kind < 1.0) return chooseEmitter(position, choices.y, numbers);
    kind -= 1.0;
  }
  if (skyShines != 0u) return chooseSky(numbers);
  return LightChoice(vec3(0.0, 1.0, 0.0), FAR_AWAY, vec3(0.0), 0.0, 0u);
}
