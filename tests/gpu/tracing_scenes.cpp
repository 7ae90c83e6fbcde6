#include "gpu/tracing_scenes.h"

#include <stdlib.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "gpu/shader_function.h"
#include "temporary_folder.h"

namespace halfsilver::testing {

void TracingTest::withShaders(const std::vector<ShaderEdit>& edits, const std::function<void()>& work) {
  namespace fs = std::filesystem;
  const TemporaryFolder folder;
  fs::copy(HALFSILVER_SOURCE_DIR "/shaders", folder.path(), fs::copy_options::recursive);
  for (const ShaderEdit& edit : edits) {
    const fs::path file = folder.path() / edit.file;
    std::ifstream in(file);
    std::string text{std::istreambuf_iterator<char>(in), {}};
    const std::size_t at = text.find(edit.from);
    ASSERT_NE(at, std::string::npos) << edit.from;
    std::ofstream(file) << text.replace(at, edit.from.size(), edit.to);
  }
  ::setenv("HALFSILVER_SHADERS", folder.path().c_str(), 1);
  work();
  ::unsetenv("HALFSILVER_SHADERS");
}

Material plain(const glm::vec3& color) {
  Material material;
  material.baseColor = glm::vec4(color, 1);
  material.metallic = 0;
  return material;
}

Material mirrorMaterial() {
  Material material = plain({0.5f, 0.5f, 0.5f});
  material.mirror = 1.0f;
  return material;
}

namespace {

std::uint32_t addVertex(Scene& scene, const glm::vec3& position, const glm::vec3& normal) {
  scene.vertices.push_back({position, normal});
  return static_cast<std::uint32_t>(scene.vertices.size() - 1);
}

}  // namespace

void addTriangle(Scene& scene, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, std::uint32_t material) {
  const glm::vec3 cross = glm::cross(b - a, c - a);
  const glm::vec3 normal = glm::length(cross) > 0 ? glm::normalize(cross) : glm::vec3(0, 1, 0);
  scene.triangles.push_back(
      {{addVertex(scene, a, normal), addVertex(scene, b, normal), addVertex(scene, c, normal)}, material});
}

namespace {

// Deterministic numbers in 0..1.
class Sequence {
 public:
  float next() {
    state_ = state_ * 1664525u + 1013904223u;
    return static_cast<float>(state_ >> 8) / 16777216.0f;
  }
  glm::vec3 point() {
    const float x = next(), y = next(), z = next();
    return {x, y, z};
  }

 private:
  std::uint32_t state_ = 12345;
};

}  // namespace

Scene soup(int triangles) {
  Scene scene;
  scene.materials = {mirrorMaterial(), plain({0.8f, 0.3f, 0.2f})};
  scene.materials[1].doubleSided = true;
  addQuad(scene, {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}, 0);
  Sequence random;
  for (int i = 0; i < triangles; ++i) {
    const glm::vec3 at = glm::vec3(-2, 0.05f, -2) + glm::vec3(4, 1.5f, 4) * random.point();
    const float size = 0.02f + 0.6f * std::pow(random.next(), 4.0f);
    const glm::vec3 half(0.5f);
    const auto corner = [&] { return at + size * (random.point() - half); };
    const glm::vec3 c = corner(), b = corner(), a = corner();
    addTriangle(scene, a, b, c, 1);
  }
  return scene;
}

void expectNontrivial(const HitErrors& errors, const Frame& exact) {
  EXPECT_GT(errors.rays, 500u);
  const std::vector<float> ids = exact.plane("hit.id");
  EXPECT_GT(std::set<float>(ids.begin(), ids.end()).size(), 20u);
}

Scene manySheets(int sheets) {
  Scene scene;
  scene.materials = {mirrorMaterial(), plain({1, 1, 1})};
  addQuad(scene, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, 0);
  for (int i = 0; i < sheets; ++i) {
    const float y = 0.5f + 0.001f * static_cast<float>(i);
    addQuad(scene, {-1, y, -1}, {1, y, -1}, {1, y, 1}, {-1, y, 1}, 1);
  }
  return scene;
}

}  // namespace halfsilver::testing
