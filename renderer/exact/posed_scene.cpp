#include "exact/posed_scene.h"

#include <vector>

namespace halfsilver {

PosedScene::PosedScene(const Scene& source, const GpuScene& posed) {
  scene_.vertices = source.vertices;
  scene_.triangles = source.triangles;
  copyMaterials(source);
  for (const PosedPart& part : posed.extents.posed()) {
    readVertices(posed, part.vertices);
    readTriangles(posed, part.triangles);
  }
}

void PosedScene::follow(const GpuScene& posed, const SceneChange& change) {
  for (const VertexRange& range : change.moved) readVertices(posed, range);
  for (const TriangleRange& range : change.turned) readTriangles(posed, range);
}

void PosedScene::copyMaterials(const Scene& source) {
  scene_.materials = source.materials;
  scene_.textures = source.textures;
}

std::uint64_t PosedScene::bytes() const {
  return scene_.vertices.size() * sizeof(Vertex) + scene_.triangles.size() * sizeof(Triangle);
}

void PosedScene::readVertices(const GpuScene& posed, const VertexRange& range) {
  const std::vector<glm::vec3> positions = posed.positions.read<glm::vec3>(range.count, range.first);
  for (std::uint32_t i = 0; i < range.count; ++i) scene_.vertices[range.first + i].position = positions[i];
}

void PosedScene::readTriangles(const GpuScene& posed, const TriangleRange& range) {
  const std::vector<glm::uvec4> triangles = posed.triangles.read<glm::uvec4>(range.count, range.first);
  for (std::uint32_t i = 0; i < range.count; ++i)
    scene_.triangles[range.first + i].vertices = {triangles[i].x, triangles[i].y, triangles[i].z};
}

}  // namespace halfsilver
