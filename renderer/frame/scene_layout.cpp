#include <halfsilver/shared_structs.h>

// What the scene is in shaders lies where they read it, see <halfsilver/shared_structs.h>.
namespace halfsilver::shared {

#define HALFSILVER_AT(type, member, offset) static_assert(offsetof(type, member) == (offset), #type "::" #member)

HALFSILVER_AT(VertexAttributes, normal, 0);
HALFSILVER_AT(VertexAttributes, bitangentSign, 12);
HALFSILVER_AT(VertexAttributes, tangent, 16);
HALFSILVER_AT(VertexAttributes, uv0, 32);
HALFSILVER_AT(VertexAttributes, uv1, 40);
HALFSILVER_AT(VertexAttributes, color, 48);
static_assert(sizeof(VertexAttributes) == 64);

HALFSILVER_AT(GpuTexture, location, 0);
HALFSILVER_AT(GpuTexture, sampling, 4);
HALFSILVER_AT(GpuTexture, transform, 8);
static_assert(sizeof(GpuTexture) == 32);

HALFSILVER_AT(GpuMaterial, baseColor, 0);
HALFSILVER_AT(GpuMaterial, emissive, 16);
HALFSILVER_AT(GpuMaterial, alphaCutoff, 28);
HALFSILVER_AT(GpuMaterial, specularColor, 32);
HALFSILVER_AT(GpuMaterial, specularFactor, 44);
HALFSILVER_AT(GpuMaterial, metallic, 48);
HALFSILVER_AT(GpuMaterial, roughness, 52);
HALFSILVER_AT(GpuMaterial, normalScale, 56);
HALFSILVER_AT(GpuMaterial, occlusionStrength, 60);
HALFSILVER_AT(GpuMaterial, dielectricF0, 64);
HALFSILVER_AT(GpuMaterial, mirror, 68);
HALFSILVER_AT(GpuMaterial, flags, 72);
HALFSILVER_AT(GpuMaterial, ior, 76);
HALFSILVER_AT(GpuMaterial, alphaFirst, 80);
HALFSILVER_AT(GpuMaterial, alphaWidth, 84);
HALFSILVER_AT(GpuMaterial, alphaHeight, 88);
HALFSILVER_AT(GpuMaterial, transmission, 92);
HALFSILVER_AT(GpuMaterial, absorption, 96);
HALFSILVER_AT(GpuMaterial, dispersion, 108);
HALFSILVER_AT(GpuMaterial, thickness, 112);
HALFSILVER_AT(GpuMaterial, coat, 116);
HALFSILVER_AT(GpuMaterial, coatRoughness, 120);
HALFSILVER_AT(GpuMaterial, coatNormalScale, 124);
HALFSILVER_AT(GpuMaterial, sheenColor, 128);
HALFSILVER_AT(GpuMaterial, sheenRoughness, 140);
HALFSILVER_AT(GpuMaterial, anisotropy, 144);
HALFSILVER_AT(GpuMaterial, anisotropyX, 148);
HALFSILVER_AT(GpuMaterial, anisotropyY, 152);
HALFSILVER_AT(GpuMaterial, textures, 160);
static_assert(sizeof(GpuMaterial) == 160 + TEXTURE_USES * sizeof(GpuTexture));

HALFSILVER_AT(GpuLight, position, 0);
HALFSILVER_AT(GpuLight, range, 12);
HALFSILVER_AT(GpuLight, direction, 16);
HALFSILVER_AT(GpuLight, type, 28);
HALFSILVER_AT(GpuLight, color, 32);
HALFSILVER_AT(GpuLight, shadowTexel, 44);
HALFSILVER_AT(GpuLight, coneScale, 48);
HALFSILVER_AT(GpuLight, coneOffset, 52);
HALFSILVER_AT(GpuLight, shadowLayer, 56);
HALFSILVER_AT(GpuLight, shadowLayers, 60);
HALFSILVER_AT(GpuLight, steadyShare, 64);
HALFSILVER_AT(GpuLight, radius, 68);
HALFSILVER_AT(GpuLight, area, 72);
HALFSILVER_AT(GpuLight, halfWidth, 80);
HALFSILVER_AT(GpuLight, halfHeight, 96);
HALFSILVER_AT(GpuLight, shadow, 112);
static_assert(sizeof(GpuLight) == 112 + 6 * sizeof(mat4));

#undef HALFSILVER_AT

}  // namespace halfsilver::shared
