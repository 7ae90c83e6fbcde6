// What methods that store attributes keep of a surface: base color, interpolated normal and reflectivity
// (Kastrati & Goswami 2017, figure 2). Only the textures that these need are read.
#include "lib/evaluate_surface.glsl"
#include "lib/fresnel.glsl"
#include "lib/scene.glsl"
#include "lib/textures.glsl"
#include "lib/triangles.glsl"

struct StoredSurface {
  vec3 baseColor;
  vec3 normal;  // unit, on the front side
  float reflectivity;
};

vec4 sampleUse(uint triangle, vec2 barycentrics, int use, vec2 changeX, vec2 changeY) {
  uvec4 corners = triangles[triangle];
  GpuTexture binding = materials[corners.w].textures[use];
  if (!hasTexture(binding)) return vec4(1.0);
  bool second = (binding.sampling & SAMPLING_UV_SET) != 0u;
  vec2 a = second ? attributes[corners.x].uv1 : attributes[corners.x].uv0;
  vec2 b = second ? attributes[corners.y].uv1 : attributes[corners.y].uv0;
  vec2 c = second ? attributes[corners.z].uv1 : attributes[corners.z].uv0;
  mat2 edges = mat2(b - a, c - a);
  return sampleTexture(binding, a + edges * barycentrics, edges * changeX, edges * changeY);
}

// footprint: the fragment's size in meters.
StoredSurface evaluateStoredSurface(uint triangle, vec2 barycentrics, float footprint) {
  uvec4 corners = triangles[triangle];
  vec3 a, b, c;
  trianglePositions(triangle, a, b, c);
  vec3 edge1 = b - a, edge2 = c - a, area = cross(edge1, edge2);
  vec3 geometric = dot(area, area) > 0.0 ? normalize(area) : vec3(0.0, 1.0, 0.0);
  vec3 major, minor;
  coneFootprint(geometric, -geometric, footprint, major, minor);
  vec2 changeX = barycentricChange(edge1, edge2, area, major);
  vec2 changeY = barycentricChange(edge1, edge2, area, minor);

  vec3 weights = vec3(1.0 - barycentrics.x - barycentrics.y, barycentrics);
  vec3 normal = attributes[corners.x].normal * weights.x + attributes[corners.y].normal * weights.y +
                attributes[corners.z].normal * weights.z;
  vec3 color = vertexColor(corners, barycentrics).rgb;
  GpuMaterial m = materials[corners.w];
  StoredSurface s;
  s.normal = dot(normal, normal) > 1e-12 ? normalize(normal) : geometric;
  s.baseColor = m.baseColor.rgb * color * sampleUse(triangle, barycentrics, TEXTURE_BASE_COLOR, changeX, changeY).rgb;
  if ((m.flags & MATERIAL_MIRROR) != 0u) {
    s.reflectivity = m.mirror;
  } else {
    vec4 texel = sampleUse(triangle, barycentrics, TEXTURE_METALLIC_ROUGHNESS, changeX, changeY);
    s.reflectivity = mix(m.dielectricF0 * m.specularFactor, luminance(s.baseColor), clamp(m.metallic * texel.b, 0.0, 1.0)) *
                     roughnessFade(clamp(m.roughness * texel.g, 0.0, 1.0));
  }
  if ((m.flags & MATERIAL_UNLIT) != 0u) s.reflectivity = 0.0;
  return s;
}
