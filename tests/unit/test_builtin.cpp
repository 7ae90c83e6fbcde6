#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include <halfsilver/builtin.h>
#include <halfsilver/error.h>
#include "builtin/parts.h"
#include "builtin/random.h"
#include "unit/area_vector.h"

namespace halfsilver {
namespace {

using glm::dvec3;
using glm::vec3;

std::map<std::string, std::size_t> trianglesByMaterial(const Scene& scene) {
  std::map<std::string, std::size_t> count;
  for (const Triangle& t : scene.triangles) ++count[scene.materials[t.material].name];
  return count;
}

const Material& materialNamed(const Scene& scene, const std::string& name) {
  const auto found =
      std::find_if(scene.materials.begin(), scene.materials.end(), [&](const Material& m) { return m.name == name; });
  if (found == scene.materials.end()) throw Error(ErrorKind::failed, "no material " + name);
  return *found;
}

struct Crossing {
  double distance = std::numeric_limits<double>::max();
  std::size_t triangle = 0;
};

std::optional<Crossing> firstCrossing(const Scene& scene, dvec3 origin, dvec3 direction) {
  std::optional<Crossing> nearest;
  for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
    const auto& index = scene.triangles[i].vertices;
    const dvec3 a(scene.vertices[index[0]].position);
    const dvec3 e1 = dvec3(scene.vertices[index[1]].position) - a, e2 = dvec3(scene.vertices[index[2]].position) - a;
    const dvec3 p = glm::cross(direction, e2);
    const double determinant = glm::dot(e1, p);
    if (std::abs(determinant) < 1e-15) continue;
    const dvec3 s = origin - a;
    const double u = glm::dot(s, p) / determinant;
    const dvec3 q = glm::cross(s, e1);
    const double v = glm::dot(direction, q) / determinant, t = glm::dot(e2, q) / determinant;
    if (u < 0 || v < 0 || u + v > 1 || t < 1e-6) continue;
    if (!nearest || t < nearest->distance) nearest = Crossing{t, i};
  }
  return nearest;
}

bool sameMaterials(const Scene& a, const Scene& b) {
  return std::equal(a.materials.begin(), a.materials.end(), b.materials.begin(), b.materials.end(),
                    [](const Material& m, const Material& n) {
                      return m.name == n.name && m.baseColor == n.baseColor && m.roughness == n.roughness;
                    });
}

class Builtin : public testing::TestWithParam<std::string> {
 protected:
  Builtin() : model(makeBuiltin(GetParam())), scene(model.scene) {}
  Model model;
  const Scene& scene;
};

std::string caseName(const testing::TestParamInfo<std::string>& info) { return info.param; }
INSTANTIATE_TEST_SUITE_P(Scenes, Builtin, testing::ValuesIn(builtinNames()), caseName);

TEST_P(Builtin, HasWhatARendererNeeds) {
  EXPECT_EQ(scene.name, "builtin:" + GetParam());
  EXPECT_GT(scene.triangles.size(), 10000u);
  EXPECT_TRUE(model.warnings.empty());
  EXPECT_EQ(model.rig.nodes.empty(), GetParam() != "game") << "only the game's level moves";
  EXPECT_EQ(model.rig.instances.empty(), GetParam() != "game");
  EXPECT_EQ(model.dropped.degenerate + model.dropped.nonFinite, 0u);
  ASSERT_FALSE(scene.lights.empty());
  for (const Light& light : scene.lights) {
    EXPECT_NEAR(glm::length(light.direction), 1, 1e-6);
    EXPECT_GT(light.intensity, 0);
  }
  std::set<std::string> cameras, materials;
  for (const Camera& camera : scene.cameras) {
    EXPECT_FALSE(camera.name.empty());
    EXPECT_TRUE(cameras.insert(camera.name).second) << camera.name;
  }
  EXPECT_GE(cameras.size(), 2u);
  for (const Material& material : scene.materials) {
    EXPECT_FALSE(material.name.empty());
    EXPECT_TRUE(materials.insert(material.name).second) << material.name;
    for (const TextureUse& use : {material.baseColorTexture, material.normalTexture})
      EXPECT_LT(use.texture, static_cast<int>(scene.textures.size()));
  }
  // Every material is used somewhere.
  EXPECT_EQ(trianglesByMaterial(scene).size(), scene.materials.size());
}

TEST_P(Builtin, VerticesAreFiniteWithUnitFrames) {
  for (const Vertex& v : scene.vertices) {
    for (int i = 0; i < 3; ++i) ASSERT_TRUE(std::isfinite(v.position[i]));
    ASSERT_NEAR(glm::length(v.normal), 1, 1e-5);
    ASSERT_NEAR(glm::length(vec3(v.tangent)), 1, 1e-5);
    ASSERT_NEAR(glm::dot(v.normal, vec3(v.tangent)), 0, 1e-5);
    ASSERT_EQ(std::abs(v.tangent.w), 1.0f);
    ASSERT_TRUE(std::isfinite(v.uv[0].x) && std::isfinite(v.uv[0].y));
  }
}

TEST_P(Builtin, TrianglesHaveAreaAndFaceAlongTheirNormals) {
  std::size_t agree = 0, single = 0;
  for (const Triangle& t : scene.triangles) {
    for (std::uint32_t index : t.vertices) ASSERT_LT(index, scene.vertices.size());
    ASSERT_LT(t.material, scene.materials.size());
    const dvec3 area = areaVector(scene, t);
    ASSERT_GT(glm::length(area), 1e-9);
    if (scene.materials[t.material].doubleSided) continue;
    ++single;
    agree += std::all_of(t.vertices.begin(), t.vertices.end(),
                         [&](std::uint32_t index) { return glm::dot(area, dvec3(scene.vertices[index].normal)) > 0; });
  }
  EXPECT_GT(static_cast<double>(agree), 0.999 * static_cast<double>(single));
}

TEST_P(Builtin, TangentsFollowTheNormalMapsTexture) {
  std::size_t agree = 0, mapped = 0;
  for (const Triangle& t : scene.triangles) {
    if (scene.materials[t.material].normalTexture.texture < 0) continue;
    ++mapped;
    const Vertex &a = scene.vertices[t.vertices[0]], &b = scene.vertices[t.vertices[1]],
                 &c = scene.vertices[t.vertices[2]];
    const dvec3 e1(b.position - a.position), e2(c.position - a.position);
    const glm::dvec2 d1(b.uv[0] - a.uv[0]), d2(c.uv[0] - a.uv[0]);
    const double determinant = d1.x * d2.y - d2.x * d1.y;
    if (determinant == 0) continue;
    const dvec3 alongU = (e1 * d2.y - e2 * d1.y) / determinant, alongV = (e2 * d1.x - e1 * d2.x) / determinant;
    // Green is up in the picture, against v.
    const dvec3 bitangent(glm::cross(a.normal, vec3(a.tangent)) * a.tangent.w);
    agree += glm::dot(alongU, dvec3(vec3(a.tangent))) > 0 && glm::dot(alongV, bitangent) < 0;
  }
  EXPECT_EQ(agree, mapped);
  if (GetParam() == "atrium") {
    EXPECT_GT(mapped, 5000u);
  }
}

TEST_P(Builtin, TwoBuildsAreIdentical) {
  const Model second = makeBuiltin(GetParam());
  const auto same = [](const auto& a, const auto& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
  };
  EXPECT_TRUE(same(scene.vertices, second.scene.vertices));
  EXPECT_TRUE(same(scene.triangles, second.scene.triangles));
  EXPECT_TRUE(sameMaterials(scene, second.scene));
  ASSERT_EQ(scene.textures.size(), second.scene.textures.size());
  for (std::size_t i = 0; i < scene.textures.size(); ++i)
    EXPECT_TRUE(same(scene.textures[i]->texels, second.scene.textures[i]->texels)) << scene.textures[i]->name;
}

TEST_P(Builtin, TexturesAreCompleteAndNormalMapsUnit) {
  for (const auto& texture : scene.textures)
    ASSERT_EQ(texture->texels.size(), static_cast<std::size_t>(texture->width * texture->height * 4)) << texture->name;
  for (const Material& material : scene.materials) {
    if (material.baseColorTexture.texture >= 0) {
      const Texture& color = *scene.textures[static_cast<std::size_t>(material.baseColorTexture.texture)];
      EXPECT_TRUE(color.srgb) << color.name;
      const auto [low, high] = std::minmax_element(color.texels.begin(), color.texels.end());
      EXPECT_LT(*low, *high) << color.name;
    }
    if (material.normalTexture.texture < 0) continue;
    const Texture& map = *scene.textures[static_cast<std::size_t>(material.normalTexture.texture)];
    EXPECT_FALSE(map.srgb) << map.name;
    vec3 mean(0);
    for (std::size_t i = 0; i < map.texels.size(); i += 4) {
      const vec3 n = vec3(map.texels[i], map.texels[i + 1], map.texels[i + 2]) / 127.5f - 1.0f;
      ASSERT_NEAR(glm::length(n), 1, 0.02) << map.name;
      mean += n;
    }
    // A tileable height field has no slope on average.
    mean /= static_cast<float>(map.texels.size() / 4);
    EXPECT_NEAR(mean.x, 0, 0.01) << map.name;
    EXPECT_NEAR(mean.y, 0, 0.01) << map.name;
    EXPECT_GT(mean.z, 0.8f) << map.name;
    EXPECT_LT(mean.z, 0.9999f) << map.name;
  }
}

TEST(BuiltinHash, IsTheSameOnEveryMachine) {
  EXPECT_EQ(hash(1), 0x688990c0u);
  EXPECT_EQ(hash(0x12345678u), 0xf5e71c96u);
  Random random(7);
  double sum = 0;
  for (int i = 0; i < 10000; ++i) {
    const double x = random.unit();
    ASSERT_GE(x, 0);
    ASSERT_LT(x, 1);
    sum += x;
  }
  EXPECT_NEAR(sum / 10000, 0.5, 0.01);
}

TEST(BuiltinNames, AnUnknownNameListsTheKnown) {
  try {
    makeBuiltin("cathedral");
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::badInput);
    const std::string what = error.what();
    EXPECT_NE(what.find("cathedral"), std::string::npos);
    for (const std::string& name : builtinNames()) EXPECT_NE(what.find(name), std::string::npos) << what;
  }
}

TEST(BuiltinSphere, IsAnExactMirrorSphere) {
  const Model model = makeBuiltin("sphere");
  const Scene& scene = model.scene;
  EXPECT_EQ(scene.triangles.size(), 37042u);
  const Material& mirror = materialNamed(scene, "mirror");
  EXPECT_EQ(mirror.metallic, 1);
  EXPECT_EQ(mirror.roughness, 0);
  EXPECT_GT(mirror.baseColor.g, 0.9f);
  EXPECT_GE(materialNamed(scene, "floor").roughness, 0.9f);
  const dvec3 center(0, 1, 0);
  std::size_t count = 0;
  for (const Triangle& t : scene.triangles) {
    if (scene.materials[t.material].name != "mirror") continue;
    ++count;
    for (const std::uint32_t index : t.vertices) {
      const dvec3 from = dvec3(scene.vertices[index].position) - center;
      ASSERT_NEAR(glm::length(from), 1, 1e-6);
      ASSERT_LT(glm::distance(from, dvec3(scene.vertices[index].normal)), 1e-6);
    }
  }
  EXPECT_EQ(count, 2u * 160u * 79u);  // the rows at the poles have half the triangles
  // Some things are behind the camera, some in front of it.
  const Camera& camera = scene.cameras.front();
  EXPECT_GT(scene.bounds().high.z, camera.eye.z + 0.5f);
  const vec3 forward = glm::normalize(camera.target - camera.eye);
  std::set<std::string> behind;
  for (const Triangle& t : scene.triangles)
    if (glm::dot(scene.vertices[t.vertices[0]].position - camera.eye, forward) < 0)
      behind.insert(scene.materials[t.material].name);
  EXPECT_GE(behind.size(), 3u);
}

// The teapot in its own units.
Scene bareTeapot(int steps) {
  MeshBuilder build;
  addTeapot(build, 1, dvec3(0), steps);
  Scene scene;
  setMesh(scene, build.take());
  return scene;
}

const Vertex* vertexAt(const Scene& scene, vec3 position) {
  const auto found = std::find_if(scene.vertices.begin(), scene.vertices.end(),
                                  [&](const Vertex& v) { return glm::distance(v.position, position) < 1e-5f; });
  return found == scene.vertices.end() ? nullptr : &*found;
}

TEST(BuiltinTeapot, PassesThroughItsCornerPoints) {
  constexpr int kSteps = 12;
  const Scene scene = bareTeapot(kSteps);
  EXPECT_EQ(scene.triangles.size(), 32u * 2 * kSteps * kSteps - 8 * kSteps);  // eight patches end in a pole
  Bounds bounds;
  for (const Vertex& v : scene.vertices) bounds.add(v.position);
  EXPECT_NEAR(bounds.low.y, 0, 1e-6);
  EXPECT_NEAR(bounds.high.y, 3.15, 1e-6);
  EXPECT_NEAR(bounds.low.x, -3, 1e-6);       // the handle
  EXPECT_NEAR(bounds.high.x, 3.434, 0.002);  // the spout's lip
  for (const vec3& corner :
       {vec3(1.4f, 2.4f, 0), vec3(0, 2.4f, 1.4f), vec3(-1.4f, 2.4f, 0), vec3(0, 2.4f, -1.4f), vec3(1.5f, 2.4f, 0),
        vec3(0, 0.9f, 2), vec3(1.3f, 2.4f, 0), vec3(0.2f, 2.7f, 0), vec3(-1.5f, 2.25f, 0), vec3(-3, 1.8f, 0),
        vec3(-1.9f, 0.6f, 0), vec3(1.7f, 1.425f, 0), vec3(2.8f, 2.4f, 0), vec3(3.2f, 2.4f, 0)})
    EXPECT_NE(vertexAt(scene, corner), nullptr) << corner.x << " " << corner.y << " " << corner.z;
  // At 45 degrees the 0.56 of the arcs makes the body 0.4 % wider than a circle.
  const float diagonal = 2 * 0.71f;
  EXPECT_NE(vertexAt(scene, {diagonal, 0.9f, diagonal}), nullptr);
}

TEST(BuiltinTeapot, NormalsAreThoseOfTheSurface) {
  const Scene scene = bareTeapot(24);
  const Vertex* top = vertexAt(scene, {0, 3.15f, 0});
  const Vertex* foot = vertexAt(scene, {0, 0, 0});
  ASSERT_TRUE(top && foot);
  for (const Vertex& v : scene.vertices) {
    if (v.position == top->position) {
      ASSERT_NEAR(v.normal.y, 1, 1e-6);
    } else if (v.position == foot->position) {
      ASSERT_NEAR(v.normal.y, -1, 1e-6);
    }
  }
  const Vertex* side = vertexAt(scene, {0, 0.9f, 2});
  ASSERT_TRUE(side);
  EXPECT_NEAR(side->normal.z, 1, 1e-6);
  // All point to the triangles' front, and close to their normal unless they are slivers.
  for (const Triangle& t : scene.triangles) {
    const dvec3 area = areaVector(scene, t);
    for (const std::uint32_t index : t.vertices)
      ASSERT_GT(glm::dot(glm::normalize(area), dvec3(scene.vertices[index].normal)), 0.8);
  }
}

TEST(BuiltinTeapot, IsSymmetric) {
  const Scene scene = bareTeapot(10);
  const auto key = [](const Vertex& v, float mirror) {
    const auto whole = [](float x) { return std::lround(static_cast<double>(x) * 1e4); };
    return std::tuple(whole(v.position.x), whole(v.position.y), whole(mirror * v.position.z), whole(v.normal.x),
                      whole(v.normal.y), whole(mirror * v.normal.z));
  };
  std::multiset<std::tuple<long, long, long, long, long, long>> all;
  for (const Vertex& v : scene.vertices) all.insert(key(v, 1));
  std::size_t missing = 0;
  for (const Vertex& v : scene.vertices) missing += all.count(key(v, -1)) == 0;
  // Rounding may put a value on either side of a step.
  EXPECT_LT(missing, scene.vertices.size() / 100);
}

TEST(BuiltinAtrium, HasThePartsThatMakeReflectionsHard) {
  const Model model = makeBuiltin("atrium");
  const Scene& scene = model.scene;
  EXPECT_EQ(scene.triangles.size(), 421658u);
  EXPECT_GE(scene.triangles.size(), 250000u);
  EXPECT_LT(scene.triangles.size(), 450000u);
  const Bounds bounds = scene.bounds();
  EXPECT_NEAR(bounds.extent().x, 14.3, 0.01);
  EXPECT_NEAR(bounds.extent().z, 30.0, 0.01);
  EXPECT_NEAR(bounds.low.y, -0.5, 1e-6);
  EXPECT_NEAR(bounds.high.y, 13.8, 0.05);

  auto count = trianglesByMaterial(scene);
  EXPECT_GT(count["railing"], 20000u);
  EXPECT_GT(count["leaves"], 10000u);
  EXPECT_GT(count["drape red"], 3000u);
  EXPECT_GT(count["drape teal"], 3000u);
  EXPECT_GT(count["drape gold"], 1000u);
  EXPECT_GT(count["limestone"], 100000u);
  for (const std::string name : {"drape red", "drape teal", "drape gold", "leaves"})
    EXPECT_TRUE(materialNamed(scene, name).doubleSided) << name;

  const Material& leaves = materialNamed(scene, "leaves");
  EXPECT_EQ(leaves.alphaMode, AlphaMode::mask);
  const Texture& sprig = *scene.textures[static_cast<std::size_t>(leaves.baseColorTexture.texture)];
  double covered = 0;
  for (std::size_t i = 3; i < sprig.texels.size(); i += 4) covered += sprig.texels[i] >= 128;
  covered /= static_cast<double>(sprig.texels.size() / 4);
  EXPECT_GT(covered, 0.15);
  EXPECT_LT(covered, 0.6);

  const Material& floor = materialNamed(scene, "floor");
  EXPECT_EQ(floor.roughness, 0);
  EXPECT_EQ(floor.metallic, 0);
  EXPECT_GE(floor.ior, 2.0f);
  EXPECT_GE(std::count_if(scene.lights.begin(), scene.lights.end(),
                          [](const Light& light) { return light.type == LightType::point; }),
            3);
  EXPECT_EQ(scene.lights.front().type, LightType::directional);
  EXPECT_GT(glm::length(materialNamed(scene, "lantern glass").emissive), 1.0f);
}

TEST(BuiltinAtrium, CamerasStandInsideAndTheFirstSeesTheFloor) {
  const Model model = makeBuiltin("atrium");
  const Scene& scene = model.scene;
  const auto nameOf = [&](const std::optional<Crossing>& hit) {
    return hit ? scene.materials[scene.triangles[hit->triangle].material].name : std::string("sky");
  };
  for (const Camera& camera : scene.cameras) {
    for (int i = 0; i < 3; ++i) {
      EXPECT_GT(camera.eye[i], scene.bounds().low[i]) << camera.name;
      EXPECT_LT(camera.eye[i], scene.bounds().high[i]) << camera.name;
    }
    // Nothing is right in front of the lens.
    const auto ahead = firstCrossing(scene, camera.eye, glm::normalize(dvec3(camera.target - camera.eye)));
    ASSERT_TRUE(ahead) << camera.name;
    EXPECT_GT(ahead->distance, 3) << camera.name;
  }
  // The lower part of the first picture is floor, at y = 0 and facing up; above it is the sky.
  const Camera& camera = scene.cameras.front();
  const dvec3 forward = glm::normalize(dvec3(camera.target - camera.eye));
  const dvec3 right = glm::normalize(glm::cross(forward, dvec3(0, 1, 0))), up = glm::cross(right, forward);
  const double half = std::tan(0.5 * static_cast<double>(camera.verticalFov));
  int floor = 0;
  for (const double x : {-0.6, -0.2, 0.2, 0.6}) {
    const auto hit = firstCrossing(scene, camera.eye, glm::normalize(forward + half * (x * right - 0.85 * up)));
    if (nameOf(hit) != "floor") continue;
    ++floor;
    EXPECT_NEAR(camera.eye.y + hit->distance * glm::normalize(forward + half * (x * right - 0.85 * up)).y, 0, 1e-4);
    EXPECT_GT(areaVector(scene, scene.triangles[hit->triangle]).y, 0);
  }
  EXPECT_EQ(floor, 4);
  // Between the thin ribs above, the sky.
  int sky = 0;
  for (int i = 0; i < 9; ++i) sky += !firstCrossing(scene, camera.eye, glm::normalize(dvec3(0.05, 1, -0.11 * i)));
  EXPECT_GE(sky, 5);
  // Walls all around, at the eye's height.
  for (int i = 0; i < 12; ++i) {
    const double angle = 2 * kPi * i / 12;
    EXPECT_TRUE(firstCrossing(scene, camera.eye, {std::cos(angle), 0.001, std::sin(angle)})) << i;
  }
}

TEST(BuiltinAtrium, SunReachesTheFloor) {
  const Model model = makeBuiltin("atrium");
  const Scene& scene = model.scene;
  const dvec3 toSun = -dvec3(scene.lights.front().direction);
  int lit = 0, dark = 0;
  for (int i = -3; i <= 3; ++i)
    for (int k = -3; k <= 3; ++k) {
      const bool free = !firstCrossing(scene, dvec3(0.93 * i, 1e-3, 3.1 * k + 0.2), toSun);
      (free ? lit : dark)++;
    }
  EXPECT_GT(lit, 5);
  EXPECT_GT(dark, 5);
}

}  // namespace
}  // namespace halfsilver
