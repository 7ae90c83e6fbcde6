// Structs that C++ writes and GLSL reads (or the other way round). A vec3 is followed by a scalar, vec2s come in pairs
// and whole rows of 16 bytes are filled, so that std140, std430 and C++ agree; <halfsilver/shared_structs.h> asserts
// every offset and size.
#ifndef HALFSILVER_STRUCTS_H
#define HALFSILVER_STRUCTS_H

#define NO_TRIANGLE 0xffffffffu
#define NO_TEXTURE 0xffffffffu

// Bits of GpuMaterial::flags.
#define MATERIAL_DOUBLE_SIDED 1u
#define MATERIAL_CUT 2u    // alpha is tested against `alphaCutoff`
#define MATERIAL_BLEND 4u  // lets light through where FrameConstants::blends; else cut at a half, without the factor
#define MATERIAL_UNLIT 8u
#define MATERIAL_MIRROR 16u  // f0 is `mirror`, roughness 0, no normal map
#define MATERIAL_TRANSMISSIVE 32u
#define MATERIAL_THIN 64u  // transmissive, a wall without an inside
#define MATERIAL_COATED 128u
#define MATERIAL_SHEEN 256u
#define MATERIAL_ANISOTROPIC 512u
#define MATERIAL_TEXTURES_SHIFT 10  // from this bit on: which of the textures exist

// GpuTexture::sampling: bits 0..1 wrap u, 2..3 wrap v (0 repeat, 1 mirror, 2 clamp), 4 nearest magnification,
// 5 nearest minification, 6 no mipmaps, 7 uv set.

// GpuLight::type of direct lights.
#define LIGHT_DIRECTIONAL 0
#define LIGHT_POINT 1
#define LIGHT_SPOT 2
#define LIGHT_RECTANGLE 3
#define LIGHT_SPHERE 4
#define NO_SHADOW -1

struct VertexAttributes {
  vec3 normal;
  float bitangentSign;
  vec3 tangent;
  float padding;
  vec2 uv0;
  vec2 uv1;
  vec4 color;  // linear
};

struct GpuTexture {
  uint location;  // bucket << 16 | layer, or NO_TEXTURE
  uint sampling;
  float transform[6];  // two rows of three
};

struct GpuMaterial {
  vec4 baseColor;
  vec3 emissive;
  float alphaCutoff;
  vec3 specularColor;
  float specularFactor;
  float metallic, roughness, normalScale, occlusionStrength;
  float dielectricF0, mirror;
  uint flags;
  float ior;
  uint alphaFirst;  // MATERIAL_CUT: the base color texture's first alpha of all, and its size
  uint alphaWidth, alphaHeight;
  float transmission;
  vec3 absorption;  // per meter inside
  float dispersion;
  float thickness, coat, coatRoughness, coatNormalScale;
  vec3 sheenColor;
  float sheenRoughness;
  float anisotropy, anisotropyX, anisotropyY, padding;  // strength, direction in the tangent plane
  GpuTexture textures[15];  // TEXTURE_BASE_COLOR ...
};
#define TEXTURE_BASE_COLOR 0
#define TEXTURE_METALLIC_ROUGHNESS 1
#define TEXTURE_NORMAL 2
#define TEXTURE_OCCLUSION 3
#define TEXTURE_EMISSIVE 4
#define TEXTURE_SPECULAR 5
#define TEXTURE_SPECULAR_COLOR 6
#define TEXTURE_TRANSMISSION 7
#define TEXTURE_THICKNESS 8
#define TEXTURE_CLEARCOAT 9
#define TEXTURE_CLEARCOAT_ROUGHNESS 10
#define TEXTURE_CLEARCOAT_NORMAL 11
#define TEXTURE_SHEEN_COLOR 12
#define TEXTURE_SHEEN_ROUGHNESS 13
#define TEXTURE_ANISOTROPY 14
#define TEXTURE_USES 15

// Lights lie in three ranges, each of one kind: direct ones (LIGHT_...), then directions that stand for a part of the
// sky each, with shadows, then halves of the sphere, evenly bright around their direction, without; of these all but
// `steadyShare` is scaled by the sky's visibility. The last two light the diffuse lobe only.
//
// Shaders fetch them as texels of floats (lib/light_list.glsl), so numbers are floats here.
struct GpuLight {
  vec3 position;
  float range;        // meters; 0: unlimited
  vec3 direction;     // unit, the way the light travels
  float type;         // LIGHT_...
  vec3 color;         // linear, times intensity; of rectangles and spheres the highest in candela
  float shadowTexel;  // width of a shadow texel, meters (point, spot: at distance 1)
  float coneScale;    // spot, rectangle: angular falloff = clamp(cosine * scale + offset), of a spot squared
  float coneOffset;
  float shadowLayer;  // the first, or NO_SHADOW
  float shadowLayers;
  float steadyShare;  // of a half of the sphere, 0..1
  float radius;       // sphere, meters
  float area;         // of a rectangle, or of a sphere's outline, square meters: color / area is its radiance
  float padding0;
  vec3 halfWidth;  // rectangle: from its center to the middle of an edge; it shines along cross(width, height)
  float padding1;
  vec3 halfHeight;
  float padding2;
  mat4 shadow[6];  // world to shadow map, one matrix per layer
};

// FrameConstants::fill.
#define FILL_SKY 0u
#define FILL_NEIGHBORS 1u

// Reflecting pixels are counted by their contribution, in classes of equal ratio from 2^-16 to 1.
#define CONTRIBUTION_CLASSES 256
#define CONTRIBUTION_OCTAVES 16

// Constants of one frame. A pixel's ray is forward + x * right + y * up, x and y in -1..1 (of its sample); if they are
// parallel it starts that far from the eye (lib/frame.glsl).
struct FrameConstants {
  mat4 viewProjection;
  vec3 eye;
  float pixelCone;    // a pixel's width at distance 1, or at all distances
  vec3 forward;       // unit
  float nearPlane;    // of the depth that targets share, meters
  vec3 right;         // times tan(half fov) times aspect
  float farPlane;     // meters; 0: infinite
  vec3 up;            // times tan(half fov)
  float minDistance;  // most of what rays take for NEAREST_SHARE, meters
  vec3 boundsLow;     // of the scene
  float diagonal;     // of the bounds, meters
  vec3 boundsHigh;
  uint skyIsImage;
  vec3 skyZenith;  // times intensity, as the next two
  float skyIntensity;
  vec3 skyHorizon;
  uint toneMap;  // 0 filmic, 1 none
  vec3 skyGround;
  float exposure;  // factor
  uint width;      // pixels
  uint height;
  uint directLights;  // the lights' ranges, see GpuLight
  uint cullBackFaces;
  float maxRoughness;
  float minReflectivity;
  float selectFraction;
  float minContribution;
  uint selectMode;     // 0 none, 1 reflective, 2 all
  uint selectPattern;  // 0 scattered, 1 region
  uint fill;           // FILL_...
  uint traces;         // of queues, in a frame whose rays come in one batch
  uint skyDirections;
  uint hemispheres;
  vec2 jitter;  // of the sample, from the pixel's center, pixels
  uint effect;    // Effect
  uint allLight;  // 1: what rays bring to a pixel is all of its light
  uint effectSamples;
  uint firstPass;         // RayPasses::first: equal constants make equal rays
  float occlusionRadius;  // meters; FAR_AWAY: none is too far
  uint glossySamples;     // reflected rays per pixel; 0: one, as from a mirror
  uint blends;            // 1: surfaces of MATERIAL_BLEND are met wherever they are not quite clear
  uint roulette;          // 1: paths that carry little light end by chance
  float layerOpacity;     // of a surface that is seen straight on
  uint transfer;          // Transfer, of layers
  uint bounces;           // trace.bounces
  uint mappedLights;      // of the direct lights, from the first: those whose shadow maps are used
  uint shadowSamples;     // rays to a light that has an extent, from the deferred shading and from reflections
  float drawnNear;  // nearer surfaces are not seen, meters
  uint parallel;    // 1: all rays of the camera go along `forward`; right and up are half the picture, in meters
  uint rayRules;    // what else decides which rays there are: of PrimarySettings and ShadowSettings
  uint coats;       // 1: clear coats have a lobe of their own, see lib/coat.glsl
  uint transmission;  // 1: what is clear is seen through in pictures that blend, see lib/clear.glsl
  uint padding[2];
};
#endif
