// All light that reaches a surface without a traced reflection. Deferred pixels and traced hits share it.
#include "lib/brdf.glsl"

layout(std430, binding = SSBO_LIGHTS) readonly buffer LightBlock { GpuLight lights[]; };
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

// Both take the light's first shadow layer, or NO_SHADOW.
//
// Orthographic maps: each tap is compared with the receiver's plane, so a flat surface never shadows itself and
// nothing has to be moved.
float directionalShadow(uint light, int layer, vec3 position, vec3 normal) {
  if (layer < 0) return 1.0;
  mat4 m = lights[light].shadow[0];
  vec3 place = (m * vec4(position, 1.0)).xyz;
  vec3 u = vec3(m[0].x, m[1].x, m[2].x);
  vec3 v = vec3(m[0].y, m[1].y, m[2].y);
  vec3 w = vec3(m[0].z, m[1].z, m[2].z);
  // Depth falls along the normal; at grazing angles the plane is cut short, there is no light to lose there.
  float towards = max(-dot(normal, w) / dot(w, w), 1e-3 * inversesqrt(dot(w, w)));
  vec2 slope = vec2(dot(normal, u) / dot(u, u), dot(normal, v) / dot(v, v)) / towards;
  return filteredShadow(place, float(layer), slope / vec2(textureSize(shadowMaps, 0).xy));
}

// Perspective maps: the receiver is moved along its normal by as much as the filter's reach can rise above its plane.
float positionalShadow(uint light, int layer, vec3 position, vec3 normal, vec3 toLight, float distanceToLight) {
  if (layer < 0) return 1.0;
  float cosine = dot(normal, toLight);
  float reach = 2.5 * lights[light].shadowTexel * distanceToLight;
  vec3 moved = position + normal * (reach * sqrt(max(1.0 - cosine * cosine, 0.0))) + toLight * (0.1 * reach);
  int face = 0;
  if (lights[light].shadowLayers > 1u) {
    vec3 away = moved - lights[light].position;
    vec3 size = abs(away);
    if (size.x >= size.y && size.x >= size.z)
      face = away.x > 0.0 ? 0 : 1;
    else if (size.y >= size.z)
      face = away.y > 0.0 ? 2 : 3;
    else
      face = away.z > 0.0 ? 4 : 5;
  }
  vec4 place = lights[light].shadow[face] * vec4(moved, 1.0);
  if (place.w <= 0.0) return 1.0;
  return filteredShadow(place.xyz / place.w, float(layer + face), vec2(0.0));
}

// Inverse square with a range window and the spot's cone (KHR_lights_punctual).
float attenuation(uint light, vec3 toLight, float distanceToLight) {
  float range = lights[light].range;
  float window = 1.0;
  if (range > 0.0) {
    float x = distanceToLight / range;
    window = clamp(1.0 - x * x * x * x, 0.0, 1.0);
  }
  float cone = 1.0;
  if (lights[light].type == LIGHT_SPOT) {
    float cosine = dot(lights[light].direction, -toLight);
    cone = clamp(cosine * lights[light].coneScale + lights[light].coneOffset, 0.0, 1.0);
  }
  return window * cone * cone / max(distanceToLight * distanceToLight, 1e-8);
}

// rgb: radiance towards the eye; a: share of the sky's light that reaches the surface, 0..1.
vec4 directLighting(Surface s, vec3 toEye) {
  if (s.unlit) return vec4(s.baseColor, 1.0);
  vec3 radiance = s.emissive;
  vec3 skyIrradiance = vec3(0.0);
  vec3 steadyBounce = vec3(0.0);
  vec3 openBounce = vec3(0.0);
  float seen = 0.0, facing = 0.0, all = 0.0;

  for (uint i = 0u; i < frame.lightCount; ++i) {
    vec3 lightDirection = lights[i].direction;
    uint type = lights[i].type;
    vec3 color = lights[i].color;
    int layer = lights[i].shadowLayer;
    if (type == LIGHT_SKY) {
      float nl = -dot(s.normal, lightDirection);
      if (layer < 0) {
        vec3 irradiance = color * (0.5 + 0.5 * nl);
        steadyBounce += irradiance * lights[i].steadyShare;
        openBounce += irradiance * (1.0 - lights[i].steadyShare);
        continue;
      }
      float weight = luminance(color);
      all += weight;
      if (nl <= 0.0) continue;
      facing += weight * nl;
      if (dot(s.geometricNormal, lightDirection) >= 0.0) continue;
      float lit = directionalShadow(i, layer, s.position, s.geometricNormal);
      seen += weight * nl * lit;
      skyIrradiance += color * (nl * lit);
      continue;
    }
    vec3 toLight = -lightDirection;
    float distanceToLight = 0.0;
    if (type != LIGHT_DIRECTIONAL) {
      toLight = lights[i].position - s.position;
      distanceToLight = length(toLight);
      toLight /= max(distanceToLight, 1e-20);
      color *= attenuation(i, toLight, distanceToLight);
    }
    if (dot(s.normal, toLight) <= 0.0 || dot(s.geometricNormal, toLight) <= 0.0 || color == vec3(0.0)) continue;
    float lit = type == LIGHT_DIRECTIONAL
                    ? directionalShadow(i, layer, s.position, s.geometricNormal)
                    : positionalShadow(i, layer, s.position, s.geometricNormal, toLight, distanceToLight);
    if (lit > 0.0) radiance += color * lit * shadeLight(s, toEye, toLight);
  }

  // A surface that looks down faces no part of the sky: half open for want of knowledge.
  float visibility = 1.0;
  if (all > 0.0) visibility = mix(0.5, seen / max(facing, 1e-20), clamp(20.0 * facing / all, 0.0, 1.0));

  vec3 bounce = steadyBounce + openBounce * visibility;
  float nv = dot(s.normal, toEye);
  vec3 reflected = skyShare(s.f0, s.roughness, nv);
  vec3 diffuse = s.baseColor * (1.0 - s.metallic) * (1.0 - reflected) * (skyIrradiance + bounce);
  // Where the sky is hidden a rough surface reflects the bounced light instead (the blend adds the visible sky).
  vec3 specular = reflected * bounce * (1.0 - visibility);
  radiance += (diffuse + specular) * (s.occlusion / PI);
  return vec4(radiance, visibility);
}
