// Surfaces as a method that stores attributes knows them. The includer says what SSBO_HIT_SURFACES is.
#include "lib/fresnel.glsl"
#include "lib/scene.glsl"
#include "lib/surface.glsl"
#include "shared/rays.h"

layout(std430, binding = SSBO_HIT_SURFACES) readonly buffer HitSurfaceBlock { HitSurface hitSurfaces[]; };

// Color, normal and reflectivity as the method stored them; the rest from the material's factors.
Surface storedSurface(uint index, Ray ray, Hit hit) {
  vec3 direction = ray.direction;
  vec3 stored = hitSurfaces[index].normal;
  uint material = triangleAt(hit.triangle).w;
  vec3 a, b, c;
  trianglePositions(hit.triangle, a, b, c);
  vec3 geometric = normalize(cross(b - a, c - a));

  Surface s;
  s.position = ray.origin + hit.t * direction;
  s.geometricNormal = dot(geometric, direction) > 0.0 ? -geometric : geometric;
  s.normal = dot(stored, direction) > 0.0 ? -stored : stored;
  s.baseColor = hitSurfaces[index].baseColor;
  s.emissive = materials[material].emissive;
  s.occlusion = 1.0;
  s.metallic = materials[material].metallic;
  s.roughness = materials[material].roughness;
  s.reflectivity = hitSurfaces[index].reflectivity;
  uint flags = materials[material].flags;
  s.unlit = (flags & MATERIAL_UNLIT) != 0u && (flags & MATERIAL_MIRROR) == 0u;
  vec3 dielectric = min(materials[material].dielectricF0 * materials[material].specularColor, vec3(1.0)) *
                    materials[material].specularFactor;
  s.f0 = mix(dielectric, s.baseColor, s.metallic);
  if ((flags & MATERIAL_MIRROR) != 0u) {
    s.f0 = vec3(materials[material].mirror);
    s.metallic = 0.0;
  }
  // The stored reflectivity holds what the roughness texture said.
  float fade = clamp(s.reflectivity / max(luminance(s.f0), 1e-6), 0.0, 1.0);
  s.roughness = fade > 0.0 ? (1.0 - fade) * frame.maxRoughness : max(s.roughness, frame.maxRoughness);
  leaveOutLayers(s);
  s.transmission = materials[material].transmission;
  s.thin = (flags & MATERIAL_THIN) != 0u;
  s.ior = materials[material].ior;
  s.dispersion = materials[material].dispersion;
  s.coat = materials[material].coat;
  s.coatRoughness = materials[material].coatRoughness;
  return s;
}
