#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include <halfsilver/bounds.h>
#include <halfsilver/gl/buffer.h>
#include <halfsilver/gl/texture.h>
#include <halfsilver/model.h>
#include <halfsilver/scene_core.h>
#include <halfsilver/shared_structs.h>

// What the stages of a frame hand on: plain move-only types that own GPU memory. See README.md of this folder.
namespace halfsilver {

// A run of SSBO_DRAW_LIST that is drawn with one state.
struct DrawRange {
  std::uint32_t first = 0, count = 0;  // triangles
  bool doubleSided = false;
  bool cut = false;  // needs the alpha test
};

// The scene on the GPU: world-space triangles (relative to Scene::origin), materials and their textures.
struct GpuScene {
  gl::Buffer positions, attributes, triangles, materials, drawList;
  std::vector<DrawRange> drawRanges;
  std::vector<gl::Texture> textures;  // buckets of equal size, at most TEXTURE_BUCKETS
  gl::Texture sky;                    // 1 x 1 where the sky is a gradient
  std::uint32_t vertexCount = 0;
  std::uint32_t triangleCount = 0;
  Bounds bounds;
  SceneCore core;
  std::uint32_t geometry = 0;       // grows with every change of the vertices
  std::uint32_t drawnGeometry = 0;  // what it was in the last frame
  std::vector<VertexRange> moved;   // since then
  std::vector<std::string> warnings;

  // Binds SSBO_POSITIONS .. SSBO_MATERIALS, the material textures and the sky.
  void bind() const;
};

// Lights with their shadow maps in one depth array.
struct ShadowMaps {
  gl::Buffer lights;  // GpuLight[lightCount], the sky's directions included
  gl::Texture maps;   // depth array
  std::uint32_t lightCount = 0;

  void bind() const;  // SSBO_LIGHTS, UNIT_SHADOW_MAPS
};

// One surface a pixel. Position is exact: the pixel's ray through the triangle, not the rasterizer's interpolation.
struct GBuffer {
  int width = 0, height = 0;
  gl::Texture depth;       // D32F, of the rasterization; reversed: 1 at the near plane, 0 far away
  gl::Texture visibility;  // R32UI: triangle + 1, or 0
  gl::Texture position;    // RGBA32F: xyz, w metres along the view axis; w = 0 where there is no surface
  gl::Texture normal;      // RGBA32F: shading normal, w reflectivity (faded by roughness)
  gl::Texture baseColor;   // RGBA16F: rgb, a occlusion
  gl::Texture material;    // RGBA16F: f0 rgb, roughness; -1 for unlit
  gl::Texture emissive;    // RGBA16F: rgb, a metallic
  gl::Texture shaded;      // RGBA32F: deferred radiance, a sky visibility
  gl::Texture reflection;  // RGBA32F: radiance of the traced rays, a 1 where traced
  std::size_t bytes() const;
};

// Rays to trace, compacted, with a count that stays on the GPU.
struct RayQueue {
  gl::Buffer rays;   // Ray[capacity]
  gl::Buffer count;  // RayCount
  std::uint32_t capacity = 0;
};

// Reflecting pixels (those that select.fraction keeps) by what their reflection contributes.
struct Contributions {
  gl::Buffer counts;  // uint[CONTRIBUTION_CLASSES], see shared/structs.h
};

// One result a ray, in the order of the queue.
struct Hits {
  gl::Buffer hits;      // Hit[capacity]
  gl::Buffer surfaces;  // HitSurface[capacity], empty unless the method stores attributes
};

}  // namespace halfsilver
