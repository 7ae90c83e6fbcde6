#include <cmath>

#include "builtin/parts.h"

// Small scenes whose pictures can be computed by hand, for what rays do beside mirrors.
namespace halfsilver {
namespace {

using glm::dvec3;

// Scatters alone: no reflection of a dielectric on top.
Material matte(std::string name, const glm::vec3& color) {
  Material material = dielectric(std::move(name), color, 1.0f);
  material.specular = 0;
  return material;
}

Material glass(std::string name, float thickness) {
  Material material = dielectric(std::move(name), glm::vec3(1), 0.0f);
  material.transmission = 1;
  material.thickness = thickness;
  return material;
}

Sky evenSky(float radiance) {
  Sky sky;
  sky.zenith = sky.horizon = sky.ground = glm::vec3(radiance);
  return sky;
}

void ball(MeshBuilder& build, const dvec3& center, double radius, int segments) {
  build.lathe(Profile().arc({0, 0}, radius, 0.5 * kPi, -0.5 * kPi, segments), center, 2 * segments);
}

// A plate on y = 0 of squares in two materials, without a texture.
void checks(MeshBuilder& build, std::uint32_t even, std::uint32_t odd, double size, int count) {
  const double low = -0.5 * size * count;
  for (int row = 0; row < count; ++row)
    for (int column = 0; column < count; ++column)
      build.use((row + column) % 2 == 0 ? even : odd)
          .rectangle({low + size * column, 0, low + size * row}, {size, 0, 0}, {0, 0, size});
}

}  // namespace

// A room of 2 m, open towards the camera: white, red on the left, green on the right, a lamp below the ceiling.
Model makeCornellScene(bool boxes) {
  Model model;
  Scene& scene = model.scene;
  const std::uint32_t white = addMaterial(scene, matte("white", glm::vec3(0.75f)));
  const std::uint32_t red = addMaterial(scene, matte("red", {0.63f, 0.065f, 0.05f}));
  const std::uint32_t green = addMaterial(scene, matte("green", {0.14f, 0.45f, 0.091f}));
  MeshBuilder build;
  build.use(white);
  build.rectangle({-1, 0, -1}, {2, 0, 0}, {0, 0, 2});
  build.rectangle({-1, 2, 1}, {2, 0, 0}, {0, 0, -2});
  build.rectangle({-1, 2, -1}, {2, 0, 0}, {0, -2, 0});
  build.use(red).rectangle({-1, 2, 1}, {0, 0, -2}, {0, -2, 0});
  build.use(green).rectangle({1, 2, -1}, {0, 0, 2}, {0, -2, 0});
  if (boxes) {
    MeshBuilder box;
    box.use(white).box({-0.3, 0, -0.3}, {0.3, 1.2, 0.3}, kAllFaces & ~kFaceBottom);
    build.append(box.mesh(), {{-0.33, 0, -0.3}, 0.31});
    box = {};
    box.use(white).box({-0.3, 0, -0.3}, {0.3, 0.6, 0.3}, kAllFaces & ~kFaceBottom);
    build.append(box.mesh(), {{0.33, 0, 0.35}, -0.29});
  }
  setMesh(scene, build.take());
  scene.sky = evenSky(0);
  Light lamp;
  lamp.type = LightType::rectangle;
  lamp.position = {0, 1.98f, 0};
  lamp.direction = {0, -1, 0};
  lamp.width = lamp.height = 0.5f;
  lamp.color = {1.0f, 0.85f, 0.62f};
  lamp.intensity = 20;
  scene.lights.push_back(lamp);
  scene.cameras.push_back(lookAt("front", {0, 1, 3.9f}, {0, 1, 0}, 39));
  return model;
}

// A white ball under a white sky: invisible if no light is lost or made.
Model makeFurnaceScene() {
  Model model;
  MeshBuilder build;
  build.use(addMaterial(model.scene, matte("white", glm::vec3(1))));
  ball(build, dvec3(0), 0.5, 64);
  setMesh(model.scene, build.take());
  model.scene.sky = evenSky(1);
  model.scene.cameras.push_back(lookAt("front", {0, 0, 2}, {0, 0, 0}, 40));
  return model;
}

// A slab of glass between 0.5 and 0.7 m over a checkered floor, which it shifts as Snell's law says.
Model makeSlabScene() {
  Model model;
  Scene& scene = model.scene;
  const std::uint32_t light = addMaterial(scene, matte("light", glm::vec3(0.8f)));
  const std::uint32_t dark = addMaterial(scene, matte("dark", glm::vec3(0.1f)));
  const std::uint32_t pane = addMaterial(scene, glass("glass", 0.2f));
  MeshBuilder build;
  checks(build, light, dark, 0.25, 32);
  build.use(pane).box({-2, 0.5, -2}, {2, 0.7, 2});
  setMesh(scene, build.take());
  scene.sky = clearSky();
  scene.lights.push_back(sunlight({-0.3f, -1, -0.2f}, glm::vec3(1), 3));
  scene.cameras.push_back(lookAt("front", {0, 2.2f, 4.2f}, {0, 0.4f, 0}, 42));
  scene.cameras.push_back(lookAt("above", {0, 4, 0.01f}, {0, 0, 0}, 42));
  return model;
}

// A prism of 60 degrees in front of a bright line, seen at the angle of least deviation, which spreads the line's
// colors.
Model makePrismScene() {
  Model model;
  Scene& scene = model.scene;
  Material flint = glass("glass", 0.5f);
  flint.dispersion = 1;  // Abbe number 20
  const std::uint32_t prism = addMaterial(scene, flint);
  const std::uint32_t black = addMaterial(scene, matte("black", glm::vec3(0)));
  Material bright = matte("line", glm::vec3(0));
  bright.emissive = glm::vec3(4);
  const std::uint32_t line = addMaterial(scene, bright);

  constexpr double kBase = 0.6, kHalfLength = 0.6, kDistance = 3;
  const double height = std::sqrt(0.75);
  MeshBuilder build;
  // The cross section in x and y, its outside to the left on the way from the apex down the right-hand side.
  Profile outline;
  outline.lines({{0, kBase + height}, {0.5, kBase}, {-0.5, kBase}, {0, kBase + height}});
  build.use(prism).extrude(outline, {0, 0, kHalfLength}, {1, 0, 0}, {0, 1, 0}, 2 * kHalfLength);
  for (const double side : {1.0, -1.0}) {
    const dvec3 normal(0, 0, side), tangent(side, 0, 0);
    const double z = side * kHalfLength;
    const std::uint32_t first = build.vertex({{0, kBase + height, z}, normal, tangent, {0.5, 0}});
    build.vertex({{-0.5 * side, kBase, z}, normal, tangent, {0, 1}});
    build.vertex({{0.5 * side, kBase, z}, normal, tangent, {1, 1}});
    build.triangle(first, first + 1, first + 2);
  }
  // Inside, the ray runs along x. Outside, it falls by half the deviation on either side.
  const double middle = kBase + 0.5 * height, half = std::asin(1.5 * 0.5) - kPi / 6;
  const double away = kDistance * std::cos(half), down = middle - kDistance * std::sin(half);
  build.use(black).rectangle({-away - 0.01, middle + 1, 2}, {0, 0, -4}, {0, -2.5, 0});
  build.use(line).rectangle({-away, down + 0.015, 1}, {0, 0, -2}, {0, -0.03, 0});
  setMesh(scene, build.take());
  scene.sky = evenSky(0);
  const glm::vec3 eye(dvec3(away, down, 0));
  scene.cameras.push_back(lookAt("front", eye, glm::vec3(dvec3(0, middle, 0)), 30));
  return model;
}

// A teapot blown of thin glass, a solid ball of green glass and a ball under red lacquer, on a mirror floor.
Model makeGlassScene() {
  Model model;
  Scene& scene = model.scene;
  const std::uint32_t floor = addMaterial(scene, metal("mirror", glm::vec3(0.9f), 0.0f));
  Material blown = glass("glass", 0);
  blown.doubleSided = true;
  const std::uint32_t teapot = addMaterial(scene, blown);
  Material bottle = glass("green glass", 1);
  bottle.attenuationColor = {0.35f, 0.85f, 0.45f};
  bottle.attenuationDistance = 0.5f;
  const std::uint32_t solid = addMaterial(scene, bottle);
  Material lacquer = metal("lacquer", {0.65f, 0.03f, 0.02f}, 0.45f);
  lacquer.coat = 1;
  const std::uint32_t coated = addMaterial(scene, lacquer);
  const std::uint32_t blue = addMaterial(scene, dielectric("blue", {0.05f, 0.14f, 0.62f}, 0.6f));
  const std::uint32_t yellow = addMaterial(scene, dielectric("yellow", {0.85f, 0.62f, 0.08f}, 0.6f));

  MeshBuilder build;
  build.use(floor).rectangle({-5, 0, -5}, {10, 0, 0}, {0, 0, 10});
  build.use(teapot);
  addTeapot(build, 0.4, dvec3(0), 16);
  build.use(solid);
  ball(build, {1.7, 0.45, 0.9}, 0.45, 48);
  build.use(coated);
  ball(build, {-1.75, 0.55, 0.6}, 0.55, 48);
  build.use(blue).roundedBox({0.6, 0, -2.4}, {1.0, 1.6, 0.5}, 0.05, 3, 0.2);
  build.use(yellow).roundedBox({-1.3, 0, -2.0}, {0.7, 0.9, 0.7}, 0.05, 3, -0.4);
  setMesh(scene, build.take());
  scene.sky = clearSky();
  scene.lights.push_back(sunlight({-0.55f, -0.80f, -0.45f}, glm::vec3(1.0f, 0.94f, 0.84f), 7.0f));
  scene.cameras.push_back(lookAt("front", {0.5f, 1.5f, 4.8f}, {0.05f, 0.55f, 0}, 46));
  return model;
}

}  // namespace halfsilver
