// How much of a light reaches a point, from the lights' shadow maps.
#include "lib/light_list.glsl"

layout(binding = UNIT_SHADOW_MAPS) uniform sampler2DArrayShadow shadowMaps;

// Along one axis, two bilinear taps in texels and what they weigh, 1 together.
struct Taps {
  vec2 low;
  vec2 high;
  vec2 lowWeight;
  vec2 highWeight;
};

// Bilinear comparison averaged over a texel: three texels with the weights 1/2 - s, 1, 1/2 + s, halved, for a place at
// -1/2 <= s <= 1/2 from the middle one. Each tap takes half of that one.
Taps sharpTaps(vec2 texel) {
  vec2 middle = floor(texel + 0.5);
  vec2 s = texel - middle;
  vec2 lowWeight = 1.0 - s, highWeight = 1.0 + s;
  return Taps(middle - (0.5 - s) / lowWeight, middle + (0.5 + s) / highWeight, 0.5 * lowWeight, 0.5 * highWeight);
}

// Bilinear comparison filtered with [1 2 1] / 4: in texels around the place (fraction s) the weights are 1-s, 2-s, 1+s,
// s, quartered.
Taps softTaps(vec2 texel) {
  vec2 base = floor(texel);
  vec2 s = texel - base;
  vec2 lowWeight = 3.0 - 2.0 * s, highWeight = 1.0 + 2.0 * s;
  return Taps(base - 1.0 + (2.0 - s) / lowWeight, base + 1.0 + s / highWeight, 0.25 * lowWeight, 0.25 * highWeight);
}

vec2 texelOf(vec2 place) { return place * vec2(textureSize(shadowMaps, 0).xy) - 0.5; }

// Share of light at a place of the shadow maps. `gradient`: change of the receiver's depth per texel.
float filteredShadow(vec3 place, float layer, vec2 gradient, Taps taps) {
  vec2 size = vec2(textureSize(shadowMaps, 0).xy);
  vec2 texel = texelOf(place.xy);
  // A bilinear comparison uses one depth for texels up to one texel away.
  float depth = place.z - abs(gradient.x) - abs(gradient.y) - 2e-5;
  vec2 lowDepth = gradient * (taps.low - texel);
  vec2 highDepth = gradient * (taps.high - texel);
  vec2 low = (taps.low + 0.5) / size;
  vec2 high = (taps.high + 0.5) / size;
  vec4 weights = vec4(taps.lowWeight.x, taps.highWeight.x, taps.lowWeight.x, taps.highWeight.x) *
                 vec4(taps.lowWeight.yy, taps.highWeight.yy);
  vec4 lit;
  lit.x = texture(shadowMaps, vec4(low, layer, depth + lowDepth.x + lowDepth.y));
  lit.y = texture(shadowMaps, vec4(high.x, low.y, layer, depth + highDepth.x + lowDepth.y));
  lit.z = texture(shadowMaps, vec4(low.x, high.y, layer, depth + lowDepth.x + highDepth.y));
  lit.w = texture(shadowMaps, vec4(high, layer, depth + highDepth.x + highDepth.y));
  return dot(lit, weights);
}

// With an edge as narrow as it can be without steps.
float sharpShadow(vec3 place, float layer, vec2 gradient) {
  return filteredShadow(place, layer, gradient, sharpTaps(texelOf(place.xy)));
}

// With a wider edge, for directions that stand for a part of the sky.
float softShadow(vec3 place, float layer, vec2 gradient) {
  return filteredShadow(place, layer, gradient, softTaps(texelOf(place.xy)));
}

// Change of a plane's depth per texel of an orthographic map. Each tap is compared with the receiver's plane, so a flat
// surface never shadows itself and nothing has to be moved. Depth falls along the normal; at grazing angles the plane
// is cut short, there is no light to lose there.
vec2 planeGradient(mat4 worldToMap, vec3 normal) {
  mat4 m = worldToMap;
  vec3 u = vec3(m[0].x, m[1].x, m[2].x);
  vec3 v = vec3(m[0].y, m[1].y, m[2].y);
  vec3 w = vec3(m[0].z, m[1].z, m[2].z);
  float towards = max(-dot(normal, w) / dot(w, w), 1e-3 * inversesqrt(dot(w, w)));
  vec2 slope = vec2(dot(normal, u) / dot(u, u), dot(normal, v) / dot(v, v)) / towards;
  return slope / vec2(textureSize(shadowMaps, 0).xy);
}

// Whether light stays parallel in a map whose texels do not (passes/visible_body.h).
bool isWarped(mat4 worldToMap) { return worldToMap[0].w != 0.0 || worldToMap[1].w != 0.0 || worldToMap[2].w != 0.0; }

// The same of such a map at one place of it, where it changes by these rows per meter.
vec2 warpedGradient(mat4 worldToMap, vec4 place, vec3 normal) {
  mat4 m = worldToMap;
  vec3 w = vec3(m[0].w, m[1].w, m[2].w);
  vec3 u = vec3(m[0].x, m[1].x, m[2].x) - place.x / place.w * w;
  vec3 v = vec3(m[0].y, m[1].y, m[2].y) - place.y / place.w * w;
  vec3 z = vec3(m[0].z, m[1].z, m[2].z) - place.z / place.w * w;
  // Ways along which one of the three changes alone, times the same number.
  vec3 alongU = cross(v, z), alongV = cross(z, u), alongZ = cross(u, v);
  float turned = dot(z, alongZ) < 0.0 ? -1.0 : 1.0;
  float towards = max(-turned * dot(normal, alongZ), 1e-3 * length(alongZ));
  return turned * vec2(dot(normal, alongU), dot(normal, alongV)) / (towards * vec2(textureSize(shadowMaps, 0).xy));
}

// A point for a perspective map: moved along its normal by as much as the filter's reach can rise above its plane.
// `texel`: width of a shadow texel at distance 1.
vec3 liftedReceiver(vec3 position, vec3 normal, vec3 toLight, float distanceToLight, float texel) {
  float cosine = dot(normal, toLight);
  float reach = 2.0 * texel * distanceToLight;
  return position + normal * (reach * sqrt(max(1.0 - cosine * cosine, 0.0))) + toLight * (0.1 * reach);
}

// The layer of a point light's six that a point lies in, as seen from the light.
int cubeFace(vec3 away) {
  vec3 size = abs(away);
  if (size.x >= size.y && size.x >= size.z) return away.x > 0.0 ? 0 : 1;
  if (size.y >= size.z) return away.y > 0.0 ? 2 : 3;
  return away.z > 0.0 ? 4 : 5;
}

// The first of a directional light's layers that a point lies in: each shows a part of the next, the last one all.
int nestedLayer(uint light, vec3 position, int layers) {
  const float FILTER = 3.0;  // texels
  float edge = 1.0 - 2.0 * FILTER / float(textureSize(shadowMaps, 0).x);
  for (int layer = 0; layer < layers - 1; ++layer) {
    vec4 place = shadowMatrix(light, layer) * vec4(position, 1.0);
    vec2 fromMiddle = abs(2.0 * place.xy / place.w - 1.0);
    if (place.w > 0.0 && max(fromMiddle.x, fromMiddle.y) <= edge) return layer;
  }
  return layers - 1;
}
