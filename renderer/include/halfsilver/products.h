#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include <halfsilver/bounds.h>
#include <halfsilver/draw_clusters.h>
#include <halfsilver/gl/buffer.h>
#include <halfsilver/gl/texel_buffer.h>
#include <halfsilver/gl/texture.h>
#include <halfsilver/model.h>
#include <halfsilver/scene_core.h>
#include <halfsilver/shared_structs.h>

// What the stages of a frame hand on: plain move-only types that own GPU memory. See README.md of this folder.
namespace halfsilver {

// Emitting triangles with the sums of their chances, see frame/light_tables.h.
struct LightTable {
  gl::TexelBuffer entries;  // uvec2: triangle, bits of the sum up to it; in the order of triangles
  std::uint32_t count = 0;
};

// The sky's cells, likewise.
struct SkyTable {
  gl::TexelBuffer sums;  // float[rows], then float[rows][columns]
  std::uint32_t rows = 0, columns = 0;
  bool shines = false;
};

// The scene on the GPU: world-space triangles (relative to Scene::origin), materials and their textures.
struct GpuScene {
  gl::Buffer positions, attributes, triangles, materials, drawList;
  gl::Buffer indices;  // uint[3 * triangles without holes]: vertices of the draw list, whose beginning these are
  std::vector<DrawRange> drawRanges;
  DrawClusters clusters;                                                           // of the draw list
  std::vector<shared::GpuMaterial> cutMaterials;                                   // those with holes
  std::uint32_t clearMaterials = 0, dispersingMaterials = 0, coatedMaterials = 0;  // of MATERIAL_TRANSMISSIVE, ...
  std::uint32_t blendingMaterials = 0;  // of AlphaMode::blend that are not opaque everywhere
  bool lobes = false;                   // a material has sheen or is anisotropic
  std::uint32_t casters = 0;  // counts changes of what casts shadows but for moves: of the draw list and of holes
  std::vector<gl::Texture> textures;  // buckets of equal size, at most TEXTURE_BUCKETS
  gl::TexelBuffer alphas;             // of the textures that cut holes, see GpuMaterial::alphaFirst
  gl::Texture sky;                    // 1 x 1 if the sky is a gradient
  SkyTable skyTable;
  LightTable emitters;
  std::vector<std::uint32_t> textureLocations;  // one per texture of the scene, see GpuTexture::location
  std::uint32_t vertexCount = 0, triangleCount = 0, materialCount = 0;
  SceneExtents extents;  // bounds and core
  std::vector<std::string> warnings;

  std::size_t geometryBytes() const;
  std::size_t textureBytes() const;
  // SSBO_POSITIONS and SSBO_TRIANGLES.
  void bindTriangles() const;
  // All of SSBO_POSITIONS to SSBO_MATERIALS, the material textures and their alpha.
  void bindSurfaces() const;
};

// How many lights of each kind there are, in the order in which they lie behind one another (see GpuLight).
struct LightRanges {
  std::uint32_t direct = 0, skyDirections = 0, hemispheres = 0;
  std::uint32_t mapped = 0;  // of the direct lights: all, or none if rays find their shadows
};

// One drawing of the scene into the shadow maps.
struct ShadowView {
  int layer = 0;
  glm::ivec4 rectangle{0};  // x, y, width, height in texels of the layer
  glm::mat4 worldToClip{1};

  bool operator==(const ShadowView&) const = default;
};

// Lights with their shadow maps in one depth array.
struct ShadowMaps {
  gl::TexelBuffer lights;  // GpuLight[], range after range
  LightRanges ranges;
  gl::Texture maps;               // depth array
  std::vector<ShadowView> views;  // what the maps hold
  // The same maps of what has never moved, from the first move on, so that a move costs what moves.
  gl::Texture still;
  std::uint32_t casters = 0;       // GpuScene::casters of the views
  std::size_t startsFollowed = 0;  // entries of DrawClusters::started() that `still` knows of
  // Of the last run of the shadow pass.
  std::size_t viewsDrawn = 0, trianglesDrawn = 0;

  std::size_t bytes() const { return lights.bytes() + maps.bytes() + still.bytes(); }
  void bind() const;  // UNIT_LIGHTS, UNIT_SHADOW_MAPS
};

// One surface per pixel, 56 bytes. Its position is exact, and not stored: the pixel's ray through the triangle, not the
// rasterizer's interpolation (surfacePoint() in shaders/lib/surface_point.glsl).
struct GBuffer {
  int width = 0, height = 0;
  gl::Texture depth;       // D32F, of the rasterization; reversed: 1 at the near plane, 0 far away
  gl::Texture visibility;  // R32UI: triangle + 1, or 0
  gl::Texture normal;      // RG32UI, see shaders/lib/packed_normal.glsl: shading normal, w reflectivity (faded by
                       // roughness), or -alpha where a ray goes on behind a surface that blends; 0 without a surface
  gl::Texture material;  // RGBA16F: f0 rgb, roughness; -1 for unlit
  gl::Texture lobes;     // RGBA32UI, only with GpuScene::lobes, see shaders/lib/gbuffer_surface.glsl
  gl::Texture coat;      // RGBA32F, only with FrameConstants::coats, see shaders/lib/coat.glsl
  // These two begin as base color, a occlusion, and emission, a metallic; deferred shading stores over them.
  gl::Texture shaded;           // RGBA32F: deferred radiance, a sky visibility
  gl::Texture reflection;       // RGBA32F: radiance of the traced rays, a 1 if traced
  gl::Texture seen, occlusion;  // RGBA32F, R16F; only with effect.glossy, see shaders/effects/reflection/seen.comp
  gl::Texture motion;           // RG32F: pixels since the frame before, right and up; only if image.motion asks for it
  // RG32UI array, a layer per 32 direct lights: bits of those that the shadow maps let through somewhere in a pixel's
  // neighborhood, and of those that they hide; in both: in doubt. Only with shadow.method = refined.
  gl::Texture shadowMarks;
  // With PrimarySettings that test or leave out: pixels whose material.a is INTERPOLATED are interpolated.
  gl::Texture tested;        // R32UI, takes turns with visibility; only while hits are tested
  gl::Buffer primaryCounts;  // uint[2]: pixels whose triangle a neighbor knew, and that are interpolated
  // uint: the number of the last frame that the GPU has run here, `number` unless it runs nothing or was reset.
  gl::Buffer signature;
  std::uint32_t number = 0;
  std::size_t bytes() const;
  // What deferred shading reads and stores over, UNIT_NORMAL to UNIT_VISIBILITY, UNIT_COAT, UNIT_LOBES if there are
  // any, IMAGE_SHADED and IMAGE_REFLECTION.
  void bindSurface() const;
};

// A picture of several samples per pixel, or of several passes of an effect: a plain sum, in the order of the frames.
struct Accumulation {
  gl::Texture sum;  // RGBA32F: radiance
  std::uint32_t samples = 0;
  std::size_t bytes() const { return sum.bytes(); }
};

// Rays to trace, compacted, with a count that stays on the GPU. First rays are a pixel each, the rest of them stands in
// the G-buffer; shaders see no difference (lib/queued_ray.glsl).
struct RayQueue {
  gl::Buffer rays;   // Ray[capacity], or uint[capacity] of pixels: what a tracer reads
  gl::Buffer paths;  // RayPath[capacity], at the same index: what the effect knows of the ray; empty for pixels
  gl::Buffer count;  // RayCount, whose `source` says which
  std::uint32_t capacity = 0;
  bool ofPixels() const { return !paths; }
  std::size_t bytes() const { return rays.bytes() + paths.bytes() + count.bytes(); }
};

// One result per ray, in the order of the queue.
struct Hits {
  gl::Buffer hits;      // Hit[capacity]
  gl::Buffer surfaces;  // HitSurface[capacity], empty unless the method stores attributes
  std::size_t bytes() const { return hits.bytes() + surfaces.bytes(); }
};

// Rays with their hits: of the first ones of a frame all, or a part if they come in several batches.
struct RayBatch {
  RayQueue rays;
  Hits hits;
  std::size_t bytes() const { return rays.bytes() + hits.bytes(); }
};

// Reflecting pixels (those that select.fraction keeps) by what their reflection contributes.
struct Contributions {
  gl::Buffer counts;  // uint[CONTRIBUTION_CLASSES], see shared/structs.h
};

// What an effect keeps for one frame.
struct EffectFrame {
  int batches = 1;  // that the frame's rays come in
  // Radiance[capacity of a batch]: a ray names its slot, and no two rays of a dispatch share one, so sums
  // depend on no order.
  gl::Buffer slots;
  RayQueue pixels;        // of a batch whose first rays are stored
  RayBatch seen, behind;  // of a band: rays that the screen answers, and those behind clear surfaces
  gl::Texture filtered;   // takes turns with GBuffer::reflection and GBuffer::seen
  Contributions contributions;
  gl::Buffer directLight;  // LightSum by pixel of a batch, if rays to lights found their shadows: on what reflected
                           // rays hit
  std::size_t bytes() const {
    return slots.bytes() + pixels.bytes() + seen.bytes() + behind.bytes() + filtered.bytes() +
           contributions.counts.bytes() + directLight.bytes();
  }
};

}  // namespace halfsilver
