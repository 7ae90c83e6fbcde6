// What a material looks like at one point of a triangle: used by the G-buffer and by every traced hit.
#include "lib/fresnel.glsl"
#include "lib/surface.glsl"
#include "lib/textures.glsl"

// Turns a normal that faces away from the viewer just past the silhouette.
vec3 faceViewer(vec3 normal, vec3 direction) {
  const float grazing = 1e-3;
  float away = dot(normal, direction);
  return away > -grazing ? normalize(normal - (away + grazing) * direction) : normal;
}

// Change of the barycentrics (u, v) along a vector in the triangle's plane; `area` is cross(edge1, edge2).
vec2 barycentricChange(vec3 edge1, vec3 edge2, vec3 area, vec3 along) {
  return vec2(dot(cross(along, edge2), area), dot(cross(edge1, along), area)) / max(dot(area, area), 1e-37);
}

// The two axes of the ellipse that a cone of the given width cuts out of the surface (Akenine-Moller, Crassin,
// Boksansky, Belcour, Panteleev, Wright, "Improved Shader and Texture Level of Detail Using Ray Cones", JCGT 2021).
void coneFootprint(vec3 normal, vec3 direction, float width, out vec3 major, out vec3 minor) {
  vec3 along = direction - dot(normal, direction) * normal;
  // Straight on, any axis will do.
  if (dot(along, along) < 1e-8) along = abs(normal.x) < 0.7 ? cross(normal, vec3(1, 0, 0)) : cross(normal, vec3(0, 1, 0));
  vec3 across = cross(normal, along);
  major = along * (width / max(length(along - dot(direction, along) * direction), 1e-4 * length(along)));
  minor = across * (width / max(length(across - dot(direction, across) * direction), 1e-4 * length(across)));
}

// The normal that a texel of a normal map means, unit; `normal` itself where the tangent says nothing.
vec3 mappedNormal(vec3 normal, vec3 tangent, float bitangentSign, vec3 texel, float scale) {
  vec3 mapped = texel * 2.0 - 1.0;
  mapped.xy *= scale;
  vec3 along = tangent - dot(tangent, normal) * normal;
  if (dot(along, along) <= 1e-12) return normal;
  along = normalize(along);
  vec3 bitangent = cross(normal, along) * (bitangentSign < 0.0 ? -1.0 : 1.0);
  vec3 bumped = mapped.x * along + mapped.y * bitangent + mapped.z * normal;
  return dot(bumped, bumped) > 1e-12 ? normalize(bumped) : normal;
}

// Which textures are read, bits of MATERIAL_TEXTURES_SHIFT: those of transmission and coat cost time even if nobody
// looks at what they say.
#ifdef LOBES
const uint BASE_TEXTURES = (1u << TEXTURE_TRANSMISSION) - 1u | 7u << TEXTURE_SHEEN_COLOR;
#else
const uint BASE_TEXTURES = (1u << TEXTURE_TRANSMISSION) - 1u;
#endif
const uint ALL_TEXTURES = (1u << TEXTURE_USES) - 1u;

// Interpolated from one corner on, so that one color in all of them is met exactly: the weights do not always add up to
// one, and a white that is a rounding step darker loses a step of half floats in the G-buffer.
vec4 vertexColor(uvec4 corners, vec2 barycentrics) {
  vec4 first = attributes[corners.x].color;
  return first + barycentrics.x * (attributes[corners.y].color - first) +
         barycentrics.y * (attributes[corners.z].color - first);
}

// direction: unit, travelling towards the surface. coneWidth: diameter of the ray's cone at the surface, meters.
// textures: BASE_TEXTURES if transmission and coat are not needed.
Surface evaluateSurface(uint triangle, vec2 barycentrics, vec3 direction, float coneWidth, uint textures) {
  uvec4 corners = triangles[triangle];
  vec3 a, b, c;
  trianglePositions(triangle, a, b, c);
  vec3 edge1 = b - a, edge2 = c - a;
  vec3 weights = vec3(1.0 - barycentrics.x - barycentrics.y, barycentrics);

  Surface s;
  s.position = a + barycentrics.x * edge1 + barycentrics.y * edge2;
  vec3 area = cross(edge1, edge2);
  float doubleArea = length(area);
  s.geometricNormal = doubleArea > 0.0 ? area / doubleArea : -direction;
  if (dot(s.geometricNormal, direction) > 0.0) s.geometricNormal = -s.geometricNormal;

  mat3 normals = mat3(attributes[corners.x].normal, attributes[corners.y].normal, attributes[corners.z].normal);
  mat3 tangents = mat3(attributes[corners.x].tangent, attributes[corners.y].tangent, attributes[corners.z].tangent);
  vec3 bitangentSigns = vec3(attributes[corners.x].bitangentSign, attributes[corners.y].bitangentSign,
                             attributes[corners.z].bitangentSign);
  // Both uv sets, xy and zw.
  mat3x4 uvs = mat3x4(vec4(attributes[corners.x].uv0, attributes[corners.x].uv1),
                      vec4(attributes[corners.y].uv0, attributes[corners.y].uv1),
                      vec4(attributes[corners.z].uv0, attributes[corners.z].uv1));
  vec4 color = vertexColor(corners, barycentrics);
  vec3 vertexNormal = normals * weights;
  vec3 tangent = tangents * weights;
  float bitangentSign = bitangentSigns.x * weights.x + bitangentSigns.y * weights.y + bitangentSigns.z * weights.z;

  vec3 major, minor;
  coneFootprint(s.geometricNormal, direction, coneWidth, major, minor);
  vec2 changeX = barycentricChange(edge1, edge2, area, major);
  vec2 changeY = barycentricChange(edge1, edge2, area, minor);
  vec4 coordinates = uvs * weights;
  vec4 uvEdge1 = uvs[1] - uvs[0];
  vec4 uvEdge2 = uvs[2] - uvs[0];
  vec4 ddx = changeX.x * uvEdge1 + changeX.y * uvEdge2;
  vec4 ddy = changeY.x * uvEdge1 + changeY.y * uvEdge2;

  uint m = corners.w;
  uint flags = materials[m].flags;
  bool mirror = (flags & MATERIAL_MIRROR) != 0u;
  // What the textures say, in variables of their own: an array with an index known at run time alone lies in memory.
  vec3 baseColor = vec3(1.0), mapped = vec3(1.0), emissive = vec3(1.0), specularColor = vec3(1.0);
  vec2 roughnessMetallic = vec2(1.0);
  float occlusion = 1.0, specular = 1.0, transmission = 1.0, thickness = 1.0, coat = 1.0, coatRoughness = 1.0;
  float alpha = 1.0;
  vec3 coatMapped = vec3(1.0);
#ifdef LOBES
  vec3 sheenColor = vec3(1.0), stretched = vec3(1.0, 0.5, 1.0);
  float sheenRoughness = 1.0;
#endif
  // Only the textures that there are, in a loop that cannot be unrolled: the sampling code is large, and software
  // rasterizers execute both sides of every branch.
  uint present = (flags >> MATERIAL_TEXTURES_SHIFT) & textures;
  uint pending = present;
  while (pending != 0u) {
    int use = findLSB(pending);
    pending &= pending - 1u;
    GpuTexture binding = materials[m].textures[use];
    bool second = (binding.sampling & SAMPLING_UV_SET) != 0u;
    vec4 texel = sampleTexture(binding, second ? coordinates.zw : coordinates.xy, second ? ddx.zw : ddx.xy,
                               second ? ddy.zw : ddy.xy);
    switch (use) {
      case TEXTURE_BASE_COLOR: baseColor = texel.rgb; alpha = texel.a; break;
      case TEXTURE_METALLIC_ROUGHNESS: roughnessMetallic = texel.gb; break;
      case TEXTURE_NORMAL: mapped = texel.xyz; break;
      case TEXTURE_OCCLUSION: occlusion = texel.r; break;
      case TEXTURE_EMISSIVE: emissive = texel.rgb; break;
      case TEXTURE_SPECULAR: specular = texel.a; break;
      case TEXTURE_SPECULAR_COLOR: specularColor = texel.rgb; break;
      case TEXTURE_TRANSMISSION: transmission = texel.r; break;
      case TEXTURE_THICKNESS: thickness = texel.g; break;
      case TEXTURE_CLEARCOAT: coat = texel.r; break;
      case TEXTURE_CLEARCOAT_ROUGHNESS: coatRoughness = texel.g; break;
#ifdef LOBES
      case TEXTURE_SHEEN_COLOR: sheenColor = texel.rgb; break;
      case TEXTURE_SHEEN_ROUGHNESS: sheenRoughness = texel.a; break;
      case TEXTURE_ANISOTROPY: stretched = texel.rgb; break;
#endif
      default: coatMapped = texel.xyz; break;
    }
  }

  s.unlit = (flags & MATERIAL_UNLIT) != 0u && !mirror;
  s.baseColor = (materials[m].baseColor * color).rgb * baseColor;
  s.alpha = (flags & MATERIAL_BLEND) != 0u ? clamp(materials[m].baseColor.a * color.a * alpha, 0.0, 1.0) : 1.0;
  s.emissive = materials[m].emissive * emissive;
  s.roughness = clamp(materials[m].roughness * roughnessMetallic.x, 0.0, 1.0);
  s.metallic = clamp(materials[m].metallic * roughnessMetallic.y, 0.0, 1.0);
  s.occlusion = 1.0 + materials[m].occlusionStrength * (occlusion - 1.0);
  vec3 dielectric = min(materials[m].dielectricF0 * materials[m].specularColor * specularColor, vec3(1.0)) *
                    (materials[m].specularFactor * specular);
  s.f0 = mix(dielectric, s.baseColor, s.metallic);

  // Degenerate attributes fall back to the triangle itself.
  vec3 normal = dot(vertexNormal, vertexNormal) > 1e-12 ? normalize(vertexNormal) : s.geometricNormal;
  float side = dot(normal, s.geometricNormal) < 0.0 ? -1.0 : 1.0;
  vec3 coatNormal = normal;
  if (mirror) {
    s.f0 = vec3(materials[m].mirror);
    s.roughness = 0.0;
    s.metallic = 0.0;
  } else if (materials[m].textures[TEXTURE_NORMAL].location != NO_TEXTURE) {
    normal = mappedNormal(normal, tangent, bitangentSign, mapped, materials[m].normalScale);
  }
  s.normal = faceViewer(side * normal, direction);
  s.reflectivity = s.unlit ? 0.0 : luminance(s.f0) * roughnessFade(s.roughness);

  s.transmission = materials[m].transmission * transmission;
  s.thin = (flags & MATERIAL_THIN) != 0u;
  s.ior = materials[m].ior;
  s.absorption = materials[m].absorption;
  s.dispersion = materials[m].dispersion;
  s.thickness = materials[m].thickness * thickness;
  s.coat = materials[m].coat * coat;
  s.coatRoughness = clamp(materials[m].coatRoughness * coatRoughness, 0.0, 1.0);
  if ((present & (1u << TEXTURE_CLEARCOAT_NORMAL)) != 0u)
    coatNormal = mappedNormal(coatNormal, tangent, bitangentSign, coatMapped, materials[m].coatNormalScale);
  s.coatNormal = faceViewer(side * coatNormal, direction);
#ifdef LOBES
  s.sheenColor = materials[m].sheenColor * sheenColor;
  s.sheenRoughness = clamp(materials[m].sheenRoughness * sheenRoughness, 0.0, 1.0);
  s.anisotropy = materials[m].anisotropy * stretched.b;
  vec2 along = 2.0 * stretched.rg - 1.0, turn = vec2(materials[m].anisotropyX, materials[m].anisotropyY);
  along = vec2(along.x * turn.x - along.y * turn.y, along.x * turn.y + along.y * turn.x);
  vec3 sideways = cross(normal, tangent) * (bitangentSign < 0.0 ? -1.0 : 1.0);
  vec3 stretch = along.x * tangent + along.y * sideways;
  stretch -= dot(stretch, s.normal) * s.normal;
  if (dot(stretch, stretch) > 1e-12)
    s.anisotropyDirection = normalize(stretch);
  else
    s.anisotropy = 0.0;  // a direction that is none
#endif
  return s;
}
