#include "frame/gpu_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

#include <halfsilver/error.h>
#include <halfsilver/shared_structs.h>
#include "frame/alpha_texels.h"
#include "frame/light_tables.h"
#include "frame/material_textures.h"
#include "frame/pack_material.h"
#include "scene/alpha.h"

namespace halfsilver {
namespace {

void checkIndices(const Scene& scene) {
  for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
    const Triangle& triangle = scene.triangles[t];
    const bool inside = std::all_of(triangle.vertices.begin(), triangle.vertices.end(),
                                    [&](std::uint32_t vertex) { return vertex < scene.vertices.size(); });
    if (!inside || triangle.material >= scene.materials.size())
      throw Error(ErrorKind::badInput, "scene '" + scene.name + "': triangle " + std::to_string(t) + " names a " +
                                           (inside ? "material" : "vertex") + " that does not exist");
  }
  for (const Material& material : scene.materials)
    for (const TextureUse* use : textureUses(material))
      if (use->texture >= static_cast<int>(scene.textures.size()) ||
          (use->texture >= 0 && !scene.textures[static_cast<std::size_t>(use->texture)]))
        throw Error(ErrorKind::badInput,
                    "scene '" + scene.name + "': material '" + material.name + "' names a texture that does not exist");
}

// Triangle numbers grouped by how they are drawn, in their own order within a group.
std::vector<std::uint32_t> groupTriangles(const Scene& scene, const std::vector<bool>& holes,
                                          std::vector<DrawRange>& ranges) {
  std::array<std::vector<std::uint32_t>, 4> groups;
  for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
    const std::size_t material = scene.triangles[t].material;
    const std::size_t group = (holes[material] ? 2u : 0u) + (seenFromBehind(scene.materials[material]) ? 1u : 0u);
    groups[group].push_back(static_cast<std::uint32_t>(t));
  }
  std::vector<std::uint32_t> order;
  order.reserve(scene.triangles.size());
  for (std::size_t group = 0; group < groups.size(); ++group) {
    if (groups[group].empty()) continue;
    ranges.push_back({static_cast<std::uint32_t>(order.size()), static_cast<std::uint32_t>(groups[group].size()),
                      (group & 1) != 0, (group & 2) != 0});
    order.insert(order.end(), groups[group].begin(), groups[group].end());
  }
  return order;
}

std::vector<glm::uvec4> packTriangles(std::span<const Triangle> triangles) {
  std::vector<glm::uvec4> packed;
  packed.reserve(triangles.size());
  for (const Triangle& triangle : triangles)
    packed.emplace_back(triangle.vertices[0], triangle.vertices[1], triangle.vertices[2], triangle.material);
  return packed;
}

void uploadIndices(const gl::Api& api, GpuScene& gpu, std::span<const glm::uvec4> triangles,
                   std::span<const std::uint32_t> order) {
  std::vector<std::uint32_t> indices;
  for (const DrawRange& range : gpu.drawRanges) {
    if (range.cut) continue;
    for (std::uint32_t i = range.first; i < range.first + range.count; ++i) {
      const glm::uvec4& triangle = triangles[order[i]];
      indices.insert(indices.end(), {triangle.x, triangle.y, triangle.z});
    }
  }
  gpu.indices = gl::makeBuffer(api, std::span<const std::uint32_t>(indices), "indices");
}

// Triangles from `first` on, wherever they are kept.
void writeTriangles(GpuScene& gpu, std::span<const glm::uvec4> triangles, std::uint32_t first) {
  // Within a range of the draw list triangles keep the scene's order: these are neighbors.
  const std::span<const std::uint32_t> drawList = gpu.clusters.drawList();
  std::vector<std::pair<std::size_t, std::vector<std::uint32_t>>> runs;  // of indices, and where they begin
  for (const DrawRange& drawn : gpu.drawRanges) {
    if (drawn.cut) continue;
    const auto numbers = drawList.subspan(drawn.first, drawn.count);
    const auto begin = std::lower_bound(numbers.begin(), numbers.end(), first);
    const auto end = std::lower_bound(begin, numbers.end(), first + triangles.size());
    auto& [place, indices] = runs.emplace_back();
    place = 3 * (drawn.first + static_cast<std::size_t>(begin - numbers.begin()));
    for (auto number = begin; number != end; ++number) {
      const glm::uvec4& triangle = triangles[*number - first];
      indices.insert(indices.end(), {triangle.x, triangle.y, triangle.z});
    }
  }
  gpu.triangles.write(triangles, first);
  for (const auto& [place, indices] : runs) gpu.indices.write(std::span<const std::uint32_t>(indices), place);
}

bool sameBytes(std::span<const shared::GpuMaterial> a, std::span<const shared::GpuMaterial> b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}

void uploadMaterials(const gl::Api& api, GpuScene& gpu, const Scene& scene, std::span<const glm::uvec4> triangles,
                     const Translucency& translucency) {
  const std::vector<bool>& holes = translucency.holes;
  gpu.blendingMaterials = translucency.blending;
  AlphaTexels alphas = uploadAlphas(api, scene, holes);
  gpu.alphas = std::move(alphas.texels);
  std::vector<shared::GpuMaterial> materials, cut;
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    materials.push_back(packMaterial(scene.materials[m], holes[m], alphas.places[m], gpu.textureLocations));
    if (holes[m]) cut.push_back(materials.back());
  }
  const auto countFlags = [&materials](std::uint32_t flags) {
    return static_cast<std::uint32_t>(
        std::count_if(materials.begin(), materials.end(),
                      [flags](const shared::GpuMaterial& material) { return (material.flags & flags) != 0; }));
  };
  gpu.clearMaterials = countFlags(MATERIAL_TRANSMISSIVE);
  gpu.dispersingMaterials = static_cast<std::uint32_t>(std::count_if(
      materials.begin(), materials.end(), [](const shared::GpuMaterial& material) { return material.dispersion > 0; }));
  gpu.coatedMaterials = countFlags(MATERIAL_COATED);
  gpu.lobes = countFlags(MATERIAL_SHEEN | MATERIAL_ANISOTROPIC) > 0;
  gpu.materials = gl::makeBuffer(api, std::span<const shared::GpuMaterial>(materials), "materials");
  if (!sameBytes(cut, gpu.cutMaterials)) ++gpu.casters;
  gpu.cutMaterials = std::move(cut);
  std::vector<DrawRange> ranges;
  std::vector<std::uint32_t> order = groupTriangles(scene, holes, ranges);
  // Most changes are of colors: the list stays, and with it what is known of moves.
  if (gpu.drawList && std::ranges::equal(order, gpu.clusters.drawList()) && ranges == gpu.drawRanges) return;
  ++gpu.casters;
  const bool replaced = static_cast<bool>(gpu.drawList);
  gpu.drawRanges = std::move(ranges);
  gpu.drawList = gl::makeBuffer(api, std::span<const std::uint32_t>(order), "draw list");
  uploadIndices(api, gpu, triangles, order);
  gpu.clusters = DrawClusters(scene, std::move(order), gpu.drawRanges, gpu.extents.posed());
  if (replaced) gpu.clusters.follow(gpu.extents.held());  // parts may have left the boxes of their animations
}

void requireCount(std::size_t has, std::size_t uploaded, const char* what) {
  if (has != uploaded)
    throw Error(ErrorKind::usage, "the scene has " + std::to_string(has) + " " + what + ", " +
                                      std::to_string(uploaded) + " were uploaded");
}

void checkChange(const GpuScene& gpu, const Scene& scene, const SceneChange& change) {
  requireCount(scene.vertices.size(), gpu.vertexCount, "vertices");
  requireCount(scene.triangles.size(), gpu.triangleCount, "triangles");
  requireCount(scene.materials.size(), gpu.materialCount, "materials");
  requireCount(scene.textures.size(), gpu.textureLocations.size(), "textures");
  for (const VertexRange& range : change.moved)
    if (range.first > gpu.vertexCount || range.count > gpu.vertexCount - range.first)
      throw Error(ErrorKind::usage, "vertices " + std::to_string(range.first) + " + " + std::to_string(range.count) +
                                        " are beyond the scene's " + std::to_string(gpu.vertexCount));
  for (const TriangleRange& range : change.turned)
    if (range.first > gpu.triangleCount || range.count > gpu.triangleCount - range.first)
      throw Error(ErrorKind::usage, "triangles " + std::to_string(range.first) + " + " + std::to_string(range.count) +
                                        " are beyond the scene's " + std::to_string(gpu.triangleCount));
  if (!change.materials) return;
  checkIndices(scene);
  for (const Material& material : scene.materials)
    for (const TextureUse* use : textureUses(material))
      if (use->texture >= 0 && gpu.textureLocations[static_cast<std::size_t>(use->texture)] == NO_TEXTURE)
        throw Error(ErrorKind::usage, "material '" + material.name +
                                          "' names a texture that no material named when the scene was uploaded");
}

}  // namespace

void writeVertices(GpuScene& gpu, std::span<const Vertex> vertices, std::size_t first) {
  std::vector<float> positions(3 * vertices.size());
  std::vector<shared::VertexAttributes> attributes(vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vertex& vertex = vertices[i];
    for (int axis = 0; axis < 3; ++axis) positions[3 * i + static_cast<std::size_t>(axis)] = vertex.position[axis];
    attributes[i] = {vertex.normal, vertex.tangent.w, glm::vec3(vertex.tangent), 0, vertex.uv[0],
                     vertex.uv[1],  vertex.color};
  }
  gpu.positions.write(std::span<const float>(positions), 3 * first);
  gpu.attributes.write(std::span<const shared::VertexAttributes>(attributes), first);
}

void turnTriangles(GpuScene& gpu, const TriangleRange& range) {
  std::vector<glm::uvec4> triangles = gpu.triangles.read<glm::uvec4>(range.count, range.first);
  for (glm::uvec4& triangle : triangles) std::swap(triangle.y, triangle.z);
  writeTriangles(gpu, triangles, range.first);
}

GpuScene uploadScene(const gl::Api& api, const Scene& scene, std::vector<PosedPart> posed) {
  checkIndices(scene);
  GpuScene gpu;
  gpu.vertexCount = static_cast<std::uint32_t>(scene.vertices.size());
  gpu.triangleCount = static_cast<std::uint32_t>(scene.triangles.size());
  gpu.materialCount = static_cast<std::uint32_t>(scene.materials.size());
  gpu.extents = SceneExtents(scene, std::move(posed));

  const std::size_t vertices = std::max<std::size_t>(1, scene.vertices.size());  // an empty buffer cannot be bound
  gpu.positions = gl::Buffer(api, vertices * 3 * sizeof(float), "positions");
  gpu.attributes = gl::Buffer(api, vertices * sizeof(shared::VertexAttributes), "attributes");
  writeVertices(gpu, scene.vertices, 0);

  const std::vector<glm::uvec4> triangles = packTriangles(scene.triangles);
  gpu.triangles = gl::makeBuffer(api, std::span<const glm::uvec4>(triangles), "triangles");

  const Translucency translucency = translucencyOf(scene);
  MaterialTextures textures = uploadTextures(api, scene);
  gpu.textures = std::move(textures.buckets);
  gpu.textureLocations = std::move(textures.locations);
  gpu.warnings = std::move(textures.warnings);
  uploadMaterials(api, gpu, scene, triangles, translucency);
  gpu.sky = uploadSky(api, scene.sky);
  gpu.skyTable = makeSkyTable(api, scene.sky);
  gpu.emitters = makeEmitters(api, scene);
  return gpu;
}

std::vector<Bounds> updateScene(const gl::Api& api, GpuScene& gpu, const Scene& scene, const SceneChange& change) {
  checkChange(gpu, scene, change);
  if (change.materials) {
    // Poses on the GPU may have turned what the caller's scene has not.
    const bool posed = !gpu.extents.posed().empty();
    uploadMaterials(api, gpu, scene,
                    posed ? gpu.triangles.read<glm::uvec4>(scene.triangles.size()) : packTriangles(scene.triangles),
                    translucencyOf(scene));
  }
  if (change.sky) {
    gpu.sky = uploadSky(api, scene.sky);
    gpu.skyTable = makeSkyTable(api, scene.sky);
  }
  if (change.materials) gpu.emitters = makeEmitters(api, scene);
  for (const VertexRange& range : change.moved)
    writeVertices(gpu, std::span(scene.vertices).subspan(range.first, range.count), range.first);
  for (const TriangleRange& range : change.turned)
    writeTriangles(gpu, packTriangles(std::span(scene.triangles).subspan(range.first, range.count)), range.first);
  gpu.extents.update(scene, change.moved);
  return gpu.clusters.update(scene, change.moved);
}

}  // namespace halfsilver
