#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <halfsilver/bounds.h>

// What the renderer draws: world-space triangles with materials, lights and a sky. glTF's conventions: right-handed,
// y up, meters, counter-clockwise front faces, linear RGB radiometry.
//
// Positions are stored as floats relative to Scene::origin (a double, in world units), so that a scene far from the
// world's origin keeps its precision. Everything positional in a Scene (vertices, lights, cameras) is relative to it.
namespace halfsilver {

struct Vertex {
  glm::vec3 position{0};          // relative to Scene::origin
  glm::vec3 normal{0, 1, 0};      // unit
  glm::vec4 tangent{1, 0, 0, 1};  // unit xyz; w is the bitangent's sign
  std::array<glm::vec2, 2> uv{glm::vec2(0), glm::vec2(0)};
  glm::vec4 color{1};  // linear, multiplies the base color
};

struct Triangle {
  std::array<std::uint32_t, 3> vertices{};  // into Scene::vertices, counter-clockwise seen from the front
  std::uint32_t material = 0;               // into Scene::materials
};

// 8-bit RGBA texels, rows from the top (v = 0 is the top row, as in glTF).
struct Texture {
  std::string name;
  int width = 0, height = 0;
  bool srgb = false;  // RGB are sRGB-encoded (base color, emissive); alpha is always linear
  std::vector<std::uint8_t> texels;
};

enum class Wrap { repeat, mirror, clamp };
enum class Filter { nearest, linear };

// How a material uses a texture; `texture` < 0 means none.
struct TextureUse {
  int texture = -1;
  int uvSet = 0;  // 0 or 1
  // KHR_texture_transform: uv' = (row0 . (u, v, 1), row1 . (u, v, 1)).
  std::array<glm::vec3, 2> transform{glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)};
  Wrap wrapU = Wrap::repeat, wrapV = Wrap::repeat;
  Filter magnify = Filter::linear, minify = Filter::linear;
  bool mipmaps = true;
};

enum class AlphaMode {
  opaque,
  mask,  // cut out where the base color's alpha is below alphaCutoff
  blend  // blended in order by Effect::layers; in all other pictures, and in shadows, cut out where texture alpha times
         // vertex alpha is below 0.5 (the factor is ignored, so that plain glass stays visible)
};

// glTF metallic-roughness with KHR_materials_ior, _specular, _emissive_strength, _unlit, _transmission, _volume,
// _dispersion, _clearcoat, _sheen and _anisotropy.
struct Material {
  std::string name;
  glm::vec4 baseColor{1};
  glm::vec3 emissive{0};  // factor times strength
  float metallic = 1;
  float roughness = 1;
  float normalScale = 1;
  float occlusionStrength = 1;
  float ior = 1.5f;
  float specular = 1;
  glm::vec3 specularColor{1};
  float alphaCutoff = 0.5f;
  AlphaMode alphaMode = AlphaMode::opaque;
  bool doubleSided = false;
  bool unlit = false;
  // Of the light that enters a dielectric: the share that passes through instead of being scattered back, 0..1.
  float transmission = 0;
  // Meters. 0: a thin wall, which bends no ray and has no inside; else the triangles close a volume, whose thickness
  // rays measure themselves.
  float thickness = 0;
  glm::vec3 attenuationColor{1};  // of white light after attenuationDistance meters inside
  float attenuationDistance = std::numeric_limits<float>::infinity();
  float dispersion = 0;  // 20 / Abbe number
  float coat = 0;        // share of the surface under the clear coat, 0..1; the coat's index of refraction is 1.5
  float coatRoughness = 0;
  float coatNormalScale = 1;
  glm::vec3 sheenColor{0};                       // of fibers over it all but the coat; 0: there are none
  float sheenRoughness = 0;                      // less than 0.2 is taken as that
  float anisotropy = 0, anisotropyRotation = 0;  // of highlights: 0..1; radians from the tangent to where they are long
  // Reflectance at normal incidence, 0..1, in place of the material's own; also makes roughness 0 and drops the normal
  // map, coat, transmission, sheen and anisotropy. See --mirror.
  std::optional<float> mirror;

  TextureUse baseColorTexture;          // sRGB
  TextureUse metallicRoughnessTexture;  // g roughness, b metallic
  TextureUse normalTexture;
  TextureUse occlusionTexture;                          // r
  TextureUse emissiveTexture;                           // sRGB
  TextureUse specularTexture;                           // a
  TextureUse specularColorTexture;                      // sRGB
  TextureUse transmissionTexture;                       // r
  TextureUse thicknessTexture;                          // g
  TextureUse coatTexture;                               // r
  TextureUse coatRoughnessTexture;                      // g
  TextureUse sheenColorTexture, sheenRoughnessTexture;  // sRGB; a
  TextureUse anisotropyTexture;                         // rg: direction in -1..1, which the rotation turns; b: strength
  TextureUse coatNormalTexture;  // the coat has the plain normal without it, whatever normalTexture says
};

// Whether triangles show their backs even if scene.cull_back_faces leaves out others: those of double-sided materials
// and of volumes, whose inside rays meet.
bool seenFromBehind(const Material& material);

// Rectangles shine from one side, spheres from all of their surface, equally bright from wherever they are seen. The
// deferred pass lights with them as with a point that sends out as much into each direction; effects sample them. As
// points do, they light and are not seen: neither the camera nor rays meet them.
enum class LightType { directional, point, spot, rectangle, sphere };

struct Light {
  LightType type = LightType::directional;
  glm::vec3 position{0};          // relative to Scene::origin, the center; all but directional
  glm::vec3 direction{0, -1, 0};  // unit, in which the light travels; directional, spot and rectangle
  glm::vec3 color{1};             // linear
  float intensity = 1;            // lux for directional, candela for point and spot, nits for rectangle and sphere
  float range = 0;                // 0: unlimited
  float innerConeAngle = 0;       // radians, half angle
  float outerConeAngle = 0.7853982f;
  glm::vec3 up{0, 0, -1};       // along a rectangle's height; need not be perpendicular to its direction
  float width = 1, height = 1;  // meters, of a rectangle
  float radius = 0.1f;          // meters, of a sphere
};

// Radiance from outside the scene: an equirectangular image if there is one, otherwise a vertical gradient.
struct Sky {
  glm::vec3 zenith{0.35f, 0.55f, 0.95f};
  glm::vec3 horizon{0.80f, 0.87f, 0.95f};
  glm::vec3 ground{0.30f, 0.28f, 0.26f};
  float intensity = 1;  // multiplies gradient and image alike
  // Linear RGB, three floats per texel, rows from the top (up); u = 0.5 + atan2(x, -z) / 2 pi; empty: the gradient.
  int imageWidth = 0, imageHeight = 0;
  std::vector<float> image;
};

struct Camera {
  std::string name;
  glm::vec3 eye{0, 0, 1};  // relative to Scene::origin
  glm::vec3 target{0};
  glm::vec3 up{0, 1, 0};
  float verticalFov = 0.8726646f;  // radians
  float parallelHeight = 0;        // meters of a parallel view from top to bottom; 0: perspective, by the field of view
  // Distances to the clipping planes in meters; 0: nothing before the camera is left out.
  float nearPlane = 0;
  float farPlane = 0;

  bool operator==(const Camera&) const = default;
};

struct Scene {
  std::string name;
  glm::dvec3 origin{0};  // world position of the relative coordinates' zero
  std::vector<Vertex> vertices;
  std::vector<Triangle> triangles;  // an index into these is the triangle's number everywhere
  std::vector<Material> materials;  // never empty if there are triangles
  std::vector<std::shared_ptr<const Texture>> textures;
  std::vector<Light> lights;
  std::vector<Camera> cameras;
  Sky sky;

  // Bounds of the vertices that triangles use.
  Bounds bounds() const;
};

// A camera that sees all of the bounds, from slightly above and to the side.
Camera frameAll(const Bounds& bounds);

}  // namespace halfsilver
