#include "gpu/light_fixture.h"

#include "frame/surface_reader.h"

namespace halfsilver::testing {

std::uint32_t addMaterial(Scene& scene, const Material& material) {
  scene.materials.push_back(material);
  return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

Material diffuse(const glm::vec3& color) {
  Material material;
  material.baseColor = glm::vec4(color, 1);
  material.metallic = 0;
  material.roughness = 1;
  material.specular = 0;
  return material;
}

Material mirror(float reflectance, const glm::vec3& color) {
  Material material = diffuse(color);
  material.mirror = reflectance;
  return material;
}

void addQuad(Scene& scene, const glm::vec3& center, const glm::vec3& halfU, const glm::vec3& halfV,
             std::uint32_t material) {
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  const glm::vec2 signs[4] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  for (const glm::vec2& sign : signs) {
    Vertex vertex;
    vertex.position = center + sign.x * halfU + sign.y * halfV;
    vertex.normal = glm::normalize(glm::cross(halfU, halfV));
    vertex.tangent = glm::vec4(glm::normalize(halfU), 1);
    vertex.uv[0] = 0.5f * sign + 0.5f;
    scene.vertices.push_back(vertex);
  }
  scene.triangles.push_back({{first, first + 1, first + 2}, material});
  scene.triangles.push_back({{first, first + 2, first + 3}, material});
}

void addBox(Scene& scene, const glm::vec3& low, const glm::vec3& high, std::uint32_t material, bool inside) {
  const glm::vec3 center = 0.5f * (low + high), half = 0.5f * (high - low);
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {-1.0f, 1.0f}) {
      glm::vec3 normal(0), u(0), v(0);
      normal[axis] = side * half[axis];
      u[(axis + 1) % 3] = half[(axis + 1) % 3];
      v[(axis + 2) % 3] = half[(axis + 2) % 3];
      const bool outwards = (side > 0) != inside;
      addQuad(scene, center + normal, outwards ? u : v, outwards ? v : u, material);
    }
}

Light sun(const glm::vec3& direction, float lux) {
  Light light;
  light.direction = glm::normalize(direction);
  light.intensity = lux;
  return light;
}

Light bulb(const glm::vec3& position, float candela) {
  Light light;
  light.type = LightType::point;
  light.position = position;
  light.intensity = candela;
  return light;
}

Sky blackSky() { return evenSky(glm::vec3(0)); }

Sky evenSky(const glm::vec3& radiance) {
  Sky sky;
  sky.zenith = sky.horizon = sky.ground = radiance;
  return sky;
}

void LightTest::draw(const Scene& scene, const Camera& camera, int width, int height) {
  gpu = uploadScene(api, scene);
  // Shadows come first: their count of lights is part of the constants.
  const ShadowBoxes boxes =
      shadowBoxes(gpu.clusters.all(), gpu.extents.bounds(), shadowPass.resolutionOf(settings.shadow), camera.eye);
  warnings = shadowPass.run(gpu, scene.lights, scene.sky, settings.shadow, boxes, {}, shadows, profiler);
  frame = makeFrameConstants(camera, gpu.extents.bounds(), scene.sky, settings, width, height, shadows.ranges);
  constants = gl::makeBuffer(api, std::span<const shared::FrameConstants>(&frame, 1), "frame");
  gbufferPass.run(view(), gbuffer);
  shadePass.run(view(), gbuffer);
}

FrameView LightTest::view() { return {gpu, shadows, constants, frame, profiler, gbuffer}; }

glm::vec4 LightTest::shadeAt(const Scene& scene, const glm::vec3& eye, const glm::vec3& target) {
  Camera camera;
  camera.eye = eye;
  camera.target = target;
  camera.nearPlane = 0.01f * glm::distance(eye, target);
  camera.verticalFov = 0.01f;
  draw(scene, camera, 3, 3);
  const glm::vec4 position = middle(SurfaceReader(api).read(view()).positions);
  EXPECT_LT(glm::distance(glm::vec3(position), target), 1e-3f * glm::distance(eye, target)) << "the point is hidden";
  return middle(pixels(gbuffer.shaded));
}

std::vector<glm::vec4> LightTest::composite(CompositePass::Output output) {
  const gl::Texture target(api, {.format = GL_RGBA32F, .width = gbuffer.width, .height = gbuffer.height}, "target");
  const gl::Framebuffer framebuffer(api);
  framebuffer.attach(GL_COLOR_ATTACHMENT0, target);
  compositePass.run(view(), output, {framebuffer.name(), 0, 0, gbuffer.width, gbuffer.height});
  return pixels(target);
}

std::vector<glm::vec4> LightTest::pixels(const gl::Texture& texture) const {
  std::vector<glm::vec4> values(static_cast<std::size_t>(texture.shape().width) *
                                static_cast<std::size_t>(texture.shape().height));
  texture.read(GL_RGBA, GL_FLOAT, values.size() * sizeof(glm::vec4), values.data());
  return values;
}

glm::vec4 LightTest::middle(const std::vector<glm::vec4>& image) const {
  return image[static_cast<std::size_t>(gbuffer.height / 2 * gbuffer.width + gbuffer.width / 2)];
}

}  // namespace halfsilver::testing
