// How much of a light reaches a point, from the lights' shadow maps.
#include "lib/light_list.glsl"

layout(binding = UNIT_SHADOW_MAPS) uniform sampler2DArrayShadow shadowMaps;

// Share of light at a place of the shadow maps: hardware's bilinear comparison filtered with [1 2 1] / 4 each way.
// In texels around the place (fraction s) the weights are 1-s, 2-s, 1+s, s: two bilinear taps each way.
// `gradient`: change of the receiver's depth per texel.
float filteredShadow(vec3 place, float layer, vec2 gradient) {
  vec2 size = vec2(textureSize(shadowMaps, 0).xy);
  vec2 texel = place.xy * size - 0.5;
  vec2 base = floor(texel);
  vec2 s = texel - base;
  vec2 lowWeight = 3.0 - 2.0 * s;
  vec2 highWeight = 1.0 + 2.0 * s;
  vec2 low = base - 1.0 + (2.0 - s) / lowWeight;
  vec2 high = base + 1.0 + s / highWeight;

  // A bilinear comparison uses one depth for texels up to one texel away.
  float depth = place.z - abs(gradient.x) - abs(gradient.y) - 2e-5;
  vec2 lowDepth = gradient * (low - texel);
  vec2 highDepth = gradient * (high - texel);
  vec2 lowPlace = (low + 0.5) / size;
  vec2 highPlace = (high + 0.5) / size;
  float lit = 0.0;
  lit += lowWeight.x * lowWeight.y * texture(shadowMaps, vec4(lowPlace, layer, depth + lowDepth.x + lowDepth.y));
  lit += highWeight.x * lowWeight.y *
         texture(shadowMaps, vec4(highPlace.x, lowPlace.y, layer, depth + highDepth.x + lowDepth.y));
  lit += lowWeight.x * highWeight.y *
         texture(shadowMaps, vec4(lowPlace.x, highPlace.y, layer, depth + lowDepth.x + highDepth.y));
  lit += highWeight.x * highWeight.y * texture(shadowMaps, vec4(highPlace, layer, depth + highDepth.x + highDepth.y));
  return lit / 16.0;
}

// Change of a plane's depth per texel of an orthographic map. Each tap is compared with the receiver's plane, so a flat
// surface never shadows itself and nothing has to be moved. Depth falls along the normal; at grazing angles the plane is
// cut short, there is no light to lose there.
vec2 planeGradient(mat4 worldToMap, vec3 normal) {
  mat4 m = worldToMap;
  vec3 u = vec3(m[0].x, m[1].x, m[2].x);
  vec3 v = vec3(m[0].y, m[1].y, m[2].y);
  vec3 w = vec3(m[0].z, m[1].z, m[2].z);
  float towards = max(-dot(normal, w) / dot(w, w), 1e-3 * inversesqrt(dot(w, w)));
  vec2 slope = vec2(dot(normal, u) / dot(u, u), dot(normal, v) / dot(v, v)) / towards;
  return slope / vec2(textureSize(shadowMaps, 0).xy);
}

// A point for a perspective map: moved along its normal by as much as the filter's reach can rise above its plane.
// `texel`: width of a shadow texel at distance 1.
vec3 liftedReceiver(vec3 position, vec3 normal, vec3 toLight, float distanceToLight, float texel) {
  float cosine = dot(normal, toLight);
  float reach = 2.5 * texel * distanceToLight;
  return position + normal * (reach * sqrt(max(1.0 - cosine * cosine, 0.0))) + toLight * (0.1 * reach);
}

// The layer of a point light's six that a point lies in, as seen from the light.
int cubeFace(vec3 away) {
  vec3 size = abs(away);
  if (size.x >= size.y && size.x >= size.z) return away.x > 0.0 ? 0 : 1;
  if (size.y >= size.z) return away.y > 0.0 ? 2 : 3;
  return away.z > 0.0 ? 4 : 5;
}
