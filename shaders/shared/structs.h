// Structs that C++ writes and GLSL reads (or the other way round). Only 16-byte members and 4-byte scalars in groups
// of four, so that std140, std430 and C++ agree; the static_asserts in frame/shared_structs.h hold them to it.
#ifndef HALFSILVER_STRUCTS_H
#define HALFSILVER_STRUCTS_H

#define NO_TRIANGLE 0xffffffffu
#define NO_TEXTURE 0xffffffffu

// Ray results in Hit::t.
#define HIT_MISS -1.0
#define HIT_NOT_TRACED -2.0
#define HIT_OVERFLOW -3.0

// Bits of GpuMaterial::flags.
#define MATERIAL_DOUBLE_SIDED 1u
#define MATERIAL_CUT 2u    // alpha is tested against `cutoff`
#define MATERIAL_BLEND 4u  // the factor's alpha is left out of the test
#define MATERIAL_UNLIT 8u
#define MATERIAL_MIRROR 16u        // f0 is `mirror`, roughness 0, no normal map
#define MATERIAL_TEXTURES_SHIFT 8  // from this bit on: which of the textures there are

// GpuTexture::sampling: bits 0..1 wrap u, 2..3 wrap v (0 repeat, 1 mirror, 2 clamp), 4 nearest magnification,
// 5 nearest minification, 6 no mipmaps, 7 uv set.

#define LIGHT_DIRECTIONAL 0u
#define LIGHT_POINT 1u
#define LIGHT_SPOT 2u
// Lights the diffuse lobe only. With a shadow layer: a direction that stands for a part of the sky. Without: half the
// sphere around the direction, evenly bright; the share 1 - cone.x of it is scaled by the sky's visibility.
#define LIGHT_SKY 3u

struct VertexAttributes {
  vec4 normalU;  // xyz normal, w uv0.x
  vec4 tangent;  // xyz tangent, w bitangent sign
  vec4 uv;       // uv0.y, uv1.x, uv1.y, unused
  vec4 color;    // linear
};

struct GpuTexture {
  uint location;  // bucket << 16 | layer, or NO_TEXTURE
  uint sampling;
  float transform[6];  // two rows of three
};

struct GpuMaterial {
  vec4 baseColor;
  vec4 emissiveCutoff;  // rgb emissive, w alpha cutoff
  vec4 specular;        // rgb specular colour, w specular factor
  float metallic;
  float roughness;
  float normalScale;
  float occlusionStrength;
  float dielectricF0;
  float mirror;
  uint flags;
  uint padding;
  GpuTexture textures[7];  // TEXTURE_BASE_COLOR ...
};
#define TEXTURE_BASE_COLOR 0
#define TEXTURE_METALLIC_ROUGHNESS 1
#define TEXTURE_NORMAL 2
#define TEXTURE_OCCLUSION 3
#define TEXTURE_EMISSIVE 4
#define TEXTURE_SPECULAR 5
#define TEXTURE_SPECULAR_COLOR 6

struct GpuLight {
  vec4 positionRange;  // xyz, w range (0: unlimited)
  vec4 directionType;  // xyz the way the light travels, w type as float
  vec4 color;          // linear times intensity; w width of a shadow texel, metres (point, spot: at distance 1)
  vec4 cone;           // x scale and y offset of the spot's angular falloff; z first shadow layer or -1; w layers
  mat4 shadow[6];      // world to shadow map, a matrix a layer
};

// One reflected ray (48 bytes).
struct Ray {
  vec4 originPixel;       // xyz; w uintBitsToFloat(y * width + x)
  vec4 directionExclude;  // unit xyz; w uintBitsToFloat(triangle that the ray starts on)
  vec4 throughput;        // rgb; w path length from the eye to the origin, metres (for texture footprints)
};

// Filled by the selection; `groups*` is an indirect dispatch of 64 rays a group.
struct RayCount {
  uint groupsX;
  uint groupsY;
  uint groupsZ;
  uint count;
  uint reflecting;  // before the selection is thinned by fraction and contribution
  uint unfinished;  // rays that a dispatch left for the next one (see tracing)
  uint overflow;    // rays that were given up
  uint padding;
};

// A build of bricks: an indirect draw of the triangles for it, then counts.
struct ListBuild {
  uint vertexCount;
  uint instanceCount;
  uint firstVertex;
  uint firstInstance;
  uint requested;     // bricks that rays wait for
  uint total;         // the last prefix sum
  uint headers;       // words before the entries, of the runs that are built
  uint longest;       // words of the longest of them
  uint stale;         // words of runs that were given up
  uint staleHeaders;  // of these, before the entries
  uint padding0;
  uint padding1;
};

// Result of one ray (16 bytes). t in metres along the unit direction; triangle is NO_TRIANGLE unless it hit.
struct Hit {
  float t;
  uint triangle;
  float u;  // barycentric weight of the second vertex
  float v;  // of the third
};

// Surface attributes of a hit as a method stored them (Kastrati & Goswami 2017, figure 2).
struct HitSurface {
  vec4 baseColor;           // rgb; w unused
  vec4 normalReflectivity;  // unit xyz, w reflectivity
};

// FrameConstants::fill.
#define FILL_SKY 0u
#define FILL_NEIGHBOURS 1u

// Reflecting pixels are counted by their contribution, in classes of equal ratio from 2^-16 to 1.
#define CONTRIBUTION_CLASSES 256
#define CONTRIBUTION_OCTAVES 16

// Constants of one frame.
struct FrameConstants {
  mat4 viewProjection;
  vec4 eye;         // xyz; w pixel cone: width at distance 1
  vec4 forward;     // unit; w near plane
  vec4 right;       // times tan(half fov) times aspect; pixel ray = forward + x * right + y * up, x, y in -1..1;
                    // w far plane, 0: infinite
  vec4 up;          // times tan(half fov)
  vec4 boundsLow;   // scene bounds; w diagonal
  vec4 boundsHigh;  // w smallest hit distance (1e-5 of the diagonal)
  vec4 skyZenith;   // rgb times intensity; w 1 where the sky is an image
  vec4 skyHorizon;  // w the image's intensity
  vec4 skyGround;
  uint width;
  uint height;
  uint lightCount;
  uint cullBackFaces;
  float maxRoughness;
  float minReflectivity;
  float selectFraction;
  float exposure;   // factor
  uint selectMode;  // 0 none, 1 reflective, 2 all
  uint toneMap;     // 0 filmic, 1 none
  uint bounces;
  uint selectPattern;  // 0 scattered, 1 region
  float minContribution;
  uint fill;
  uint padding0;
  uint padding1;
};

#endif
