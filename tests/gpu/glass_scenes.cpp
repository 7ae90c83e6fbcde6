#include "gpu/glass_scenes.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "builtin/mesh_builder.h"
#include "gpu/light_fixture.h"
#include "gpu/tracing_scenes.h"

namespace halfsilver::testing {

using glm::dvec3;
using glm::vec3;

double reflectance(double cosine, double ratio) {
  const double sine2 = ratio * ratio * (1 - cosine * cosine);
  if (sine2 >= 1) return 1;
  const double behind = std::sqrt(1 - sine2);
  const double p = (cosine - ratio * behind) / (cosine + ratio * behind);
  const double s = (ratio * cosine - behind) / (ratio * cosine + behind);
  return 0.5 * (p * p + s * s);
}

dvec3 pixelRay(const Camera& camera, int x, int y, int width, int height) {
  const dvec3 forward = glm::normalize(dvec3(camera.target - camera.eye));
  const dvec3 right = glm::normalize(glm::cross(forward, dvec3(0, 1, 0))), up = glm::cross(right, forward);
  const double tangent = std::tan(0.5 * static_cast<double>(camera.verticalFov));
  const double sx = (2.0 * x + 1 - width) / height * tangent, sy = (height - 2.0 * y - 1) / height * tangent;
  return glm::normalize(forward + sx * right + sy * up);
}

Material unlit(const vec3& color) {
  Material material = plain(color);
  material.unlit = true;
  return material;
}

Material glass(float ior, float thickness) {
  Material material = plain(vec3(1));
  material.roughness = 0;
  material.transmission = 1;
  material.ior = ior;
  material.thickness = thickness;
  return material;
}

void addTellingFloor(Scene& scene) {
  const std::size_t first = scene.vertices.size();
  const float half = static_cast<float>(0.5 * kSpan);
  addQuad(scene, vec3(0), {half, 0, 0}, {0, 0, -half}, addMaterial(scene, unlit(vec3(1))));
  for (std::size_t i = first; i < scene.vertices.size(); ++i) {
    const vec3 place = scene.vertices[i].position / static_cast<float>(kSpan) + 0.5f;
    scene.vertices[i].color = {place.x, place.z, 1, 1};
  }
}

Scene slabOverFloor(const Material& material) {
  Scene scene;
  scene.sky = blackSky();
  addTellingFloor(scene);
  const auto slab = addMaterial(scene, material);
  if (material.thickness > 0)
    addBox(scene, {-9, static_cast<float>(kLow), -9}, {9, static_cast<float>(kHigh), 9}, slab);
  else
    addQuad(scene, {0, static_cast<float>(kHigh), 0}, {9, 0, 0}, {0, 0, -9}, slab);
  return scene;
}

const Camera kOverSlab = lookAt({0.3f, 2.1f, 1.9f}, {0, 0.9f, 0});
const Camera kOntoSlab = lookAt({0.3f, 2.9f, 1.1f}, {0, 0.9f, 0});

Scene glassAmongTriangles() {
  Scene scene = soup(150);
  Material green = glass(1.5f, 1);
  green.attenuationColor = {0.3f, 0.9f, 0.4f};
  MeshBuilder build;
  build.lathe(Profile().arc({0, 0}, 0.6, glm::half_pi<double>(), -glm::half_pi<double>(), 24), {0, 0.8, 1}, 48);
  const auto first = static_cast<std::uint32_t>(scene.vertices.size()), material = addMaterial(scene, green);
  scene.vertices.insert(scene.vertices.end(), build.mesh().vertices.begin(), build.mesh().vertices.end());
  for (Triangle triangle : build.mesh().triangles) {
    for (std::uint32_t& vertex : triangle.vertices) vertex += first;
    triangle.material = material;
    scene.triangles.push_back(triangle);
  }
  Light lamp;
  lamp.type = LightType::point;
  lamp.position = {1, 2.5f, 1.5f};
  lamp.intensity = 5;
  scene.lights = {sun({-0.3f, -1, -0.4f}, 2), lamp};
  return scene;
}

}  // namespace halfsilver::testing
