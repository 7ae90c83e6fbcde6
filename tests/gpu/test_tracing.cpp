// Known answers and invariants of the tracers, through the public renderer.
#include <cmath>
#include <set>
#include <string>

#include <halfsilver/io.h>
#include <halfsilver/tracer.h>
#include "gpu/shader_function.h"
#include "gpu/tracing_scenes.h"

namespace halfsilver::testing {
namespace {

// A ray from a mirror plane meets a marker exactly where the mirrored camera ray would.
TEST_F(TracingTest, MirrorPlaneShowsTheMarkerWhereGeometryPredicts) {
  Scene scene;
  scene.materials = {mirrorMaterial(), plain({1, 0, 0})};
  addQuad(scene, {-5, 0, 5}, {5, 0, 5}, {5, 0, -5}, {-5, 0, -5}, 0);
  const glm::vec3 low(-0.4f, 1.0f, -2.0f), high(0.6f, 1.8f, -2.0f);
  addQuad(scene, {low.x, low.y, low.z}, {high.x, low.y, low.z}, {high.x, high.y, low.z}, {low.x, high.y, low.z}, 1);
  const glm::vec3 eye(0, 1.5f, 3);
  const Camera camera = lookAt(eye, {0, 0, -1});
  const int width = 96, height = 72;
  const Frame frame = draw(scene, camera, settingsWith({}), width, height);

  const glm::vec3 forward = glm::normalize(camera.target - camera.eye), right(1, 0, 0), up = glm::cross(right, forward);
  const float tangent = std::tan(0.5f * camera.verticalFov);
  int seen = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float px = (2 * (static_cast<float>(x) + 0.5f) / width - 1) * tangent * width / height;
      const float py = (1 - 2 * (static_cast<float>(y) + 0.5f) / height) * tangent;
      const glm::vec3 ray = forward + px * right + py * up;
      if (frame.at(x, y, "selected.Y") == 0) continue;
      const glm::vec3 floorPoint = eye - ray * (eye.y / ray.y);
      const glm::vec3 mirrored = glm::normalize(glm::vec3(ray.x, -ray.y, ray.z));
      const float t = (low.z - floorPoint.z) / mirrored.z;
      const glm::vec3 p = floorPoint + t * mirrored;
      const float inside = std::min(std::min(p.x - low.x, high.x - p.x), std::min(p.y - low.y, high.y - p.y));
      if (std::abs(inside) < 1e-3f) continue;  // the edge itself
      if (inside > 0 && t > 0) {
        ++seen;
        ASSERT_NEAR(frame.at(x, y, "hit.T"), t, 1e-4f * t) << x << "," << y;
        ASSERT_GE(frame.at(x, y, "hit.id"), 2.0f);
        EXPECT_NEAR(std::abs(frame.at(x, y, "hit.nz")), 1.0f, 1e-5f);
      } else {
        ASSERT_EQ(frame.at(x, y, "hit.T"), -1.0f) << x << "," << y;
      }
    }
  EXPECT_GT(seen, 50);
}

// Rays against a finely tessellated sphere follow the closed form within the tessellation's error.
TEST_F(TracingTest, MirrorFloorUnderASphereFollowsTheClosedForm) {
  Scene scene;
  scene.materials = {mirrorMaterial(), plain({0.2f, 0.5f, 0.9f})};
  scene.materials[1].doubleSided = true;
  addQuad(scene, {-3, 0, 3}, {3, 0, 3}, {3, 0, -3}, {-3, 0, -3}, 0);
  const glm::vec3 center(0, 1.2f, 0);
  const float radius = 0.8f;
  const int rings = 96, sectors = 192;
  const auto point = [&](int ring, int sector) {
    const float theta = 3.14159265f * static_cast<float>(ring) / rings;
    const float phi = 6.2831853f * static_cast<float>(sector % sectors) / sectors;
    return center +
           radius * glm::vec3(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
  };
  for (int ring = 0; ring < rings; ++ring)
    for (int sector = 0; sector < sectors; ++sector) {
      const glm::vec3 a = point(ring, sector), b = point(ring + 1, sector), c = point(ring + 1, sector + 1),
                      d = point(ring, sector + 1);
      if (ring + 1 < rings) addTriangle(scene, a, c, b, 1);
      if (ring > 0) addTriangle(scene, a, d, c, 1);
    }
  const glm::vec3 eye(0, 2.2f, 4);
  const Camera camera = lookAt(eye, {0, 0.3f, 0});
  const int width = 64, height = 48;
  const Frame frame = draw(scene, camera, settingsWith({}), width, height);
  const glm::vec3 forward = glm::normalize(camera.target - camera.eye), right(1, 0, 0), up = glm::cross(right, forward);
  const float tangent = std::tan(0.5f * camera.verticalFov);
  const float sagitta = radius * (1 - std::cos(3.14159265f / rings));
  int seen = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      if (frame.at(x, y, "selected.Y") == 0) continue;
      const float px = (2 * (static_cast<float>(x) + 0.5f) / width - 1) * tangent * width / height;
      const float py = (1 - 2 * (static_cast<float>(y) + 0.5f) / height) * tangent;
      const glm::vec3 ray = forward + px * right + py * up;
      const glm::vec3 start = eye - ray * (eye.y / ray.y);
      const glm::vec3 direction = glm::normalize(glm::vec3(ray.x, -ray.y, ray.z));
      const float b = glm::dot(start - center, direction);
      const float discriminant = b * b - (glm::dot(start - center, start - center) - radius * radius);
      if (std::abs(discriminant) < 0.02f) continue;  // near the outline
      if (discriminant < 0) {
        EXPECT_EQ(frame.at(x, y, "hit.T"), -1.0f);
        continue;
      }
      ++seen;
      const float slack = sagitta * radius / std::sqrt(discriminant) + 1e-4f;
      EXPECT_NEAR(frame.at(x, y, "hit.T"), -b - std::sqrt(discriminant), slack);
    }
  EXPECT_GT(seen, 100);
}

// Rays through shared edges and vertices: a closed fan of triangles around points that rays meet exactly.
TEST_F(TracingTest, NoRaySlipsThroughSharedEdges) {
  Scene scene;
  scene.materials = {mirrorMaterial(), plain({1, 1, 0})};
  addQuad(scene, {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}, 0);
  // A ceiling grid whose edges lie on planes that contain many of the mirrored rays (x = multiples of 1/8).
  const int cells = 32;
  for (int z = 0; z < cells; ++z)
    for (int x = 0; x < cells; ++x) {
      const auto corner = [&](int i, int k) {
        return glm::vec3(-2 + static_cast<float>(i) * 0.125f, 1, -2 + static_cast<float>(k) * 0.125f);
      };
      addTriangle(scene, corner(x, z), corner(x + 1, z), corner(x + 1, z + 1), 1);
      addTriangle(scene, corner(x, z), corner(x + 1, z + 1), corner(x, z + 1), 1);
    }
  Camera camera = lookAt({0, 0.5f, 0}, {0, 0, 0});
  camera.up = {0, 0, -1};
  // The rays of a square view's diagonals lie in the planes of the ceiling's diagonal edges.
  camera.verticalFov = 2 * std::atan(64.0f / 108.0f);  // and every ninth column meets an edge
  const Frame frame = draw(scene, camera, settingsWith({}), 64, 64);
  int traced = 0;
  for (const float t : frame.plane("hit.T")) {
    if (t == -2) continue;
    ++traced;
    ASSERT_GT(t, 0.9f);
  }
  EXPECT_EQ(traced, 64 * 64);
}

// A setting that the method's tracer is not made from keeps it and what it has built.
TEST_F(TracingTest, SettingsThatNoStructureDependsOnKeepTheTracer) {
  const Scene scene = soup(100);
  for (const char* method : {"identity", "attributes"}) {
    int made = 0;
    Renderer renderer([this](const char* name) { return context.getProcAddress()(name); },
                      std::vector<Method>{{methodInfo(method), [&made](const gl::Api& table, const Settings& settings) {
                                             ++made;
                                             return makeTracer(table, settings, {});
                                           }}});
    renderer.setScene(scene);
    Settings settings = settingsWith({{"trace.method", method}, {"abuffer.resolution", "64"}});
    drawWith(renderer, kAbove, settings, 32, 24);
    for (const auto& [name, value] :
         {std::pair("trace.bounces", "2"), std::pair("scene.cull_back_faces", "false"), std::pair("select.mode", "all"),
          std::pair("select.fraction", "0.5"), std::pair("image.exposure", "1"), std::pair("shadow.resolution", "32"),
          method == std::string("identity") ? std::pair("search.steps", "7") : std::pair("voxels.per_triangle", "2")}) {
      set(settings, name, value);
      drawWith(renderer, kAbove, settings, 32, 24);
      EXPECT_EQ(made, 1) << method << " " << name;
    }
    set(settings, "voxels.resolution", "8");
    drawWith(renderer, kAbove, settings, 32, 24);
    EXPECT_EQ(made, 2) << method;
  }
}

// Every fragment stored once, in the axis of its triangle: a floor has exactly one fragment a texel that it covers.
TEST_F(TracingTest, FragmentsOfAFloorAreCountedExactly) {
  Scene scene;
  scene.materials = {mirrorMaterial(), plain({1, 1, 1})};
  // Bounds are the grid's: 0..4 x 0..4 x 0..4 with the padding of makeGrid.
  addQuad(scene, {0, 0, 4}, {4, 0, 4}, {4, 0, 0}, {0, 0, 0}, 0);
  addTriangle(scene, {0, 4, 0}, {0.001f, 4, 0}, {0, 4, 0.001f}, 1);
  const int texels = 64;
  const Frame frame = draw(scene, lookAt({2, 3, 3}, {2, 0, 2}),
                           settingsWith({{"trace.method", "attributes"},
                                         {"voxels.axis", "own"},
                                         {"abuffer.resolution", "64"},
                                         {"voxels.resolution", "16"}}),
                           16, 12);
  // Plain rasterization covers each texel center once; the diagonal is shared by rule. The tiny triangle covers none.
  // The padding is 0.001 of the extent, less than half a texel, so every center is inside.
  EXPECT_EQ(frame.report.memory.fragmentsStored, static_cast<std::uint64_t>(texels * texels));
  EXPECT_EQ(frame.report.memory.fragmentsPerAxis[1], static_cast<std::uint64_t>(texels * texels));
  EXPECT_EQ(frame.report.memory.fragmentsPerAxis[0] + frame.report.memory.fragmentsPerAxis[2], 0u);

  const Frame three = draw(scene, lookAt({2, 3, 3}, {2, 0, 2}),
                           settingsWith({{"trace.method", "attributes"},
                                         {"abuffer.buffers", "three"},
                                         {"abuffer.resolution", "64"},
                                         {"voxels.resolution", "16"}}),
                           16, 12);
  EXPECT_EQ(three.report.memory.fragmentsPerAxis[1], static_cast<std::uint64_t>(texels * texels));
}

// A step's wall stands along the axis of its voxels' A-buffer, so it leaves no fragment there: a ray meets it where it
// comes to lie inside. The rays come down from a mirror overhead.
TEST_F(TracingTest, StepsOfTheSearchDoNotPassSteepWalls) {
  Scene scene;
  scene.materials = {mirrorMaterial(), plain({1, 1, 1})};
  scene.materials[0].doubleSided = true;
  addQuad(scene, {-2, 1, 2}, {2, 1, 2}, {2, 1, -0.5f}, {-2, 1, -0.5f}, 0);
  // The floor ends where the step's top begins; together they outweigh the wall between them.
  addQuad(scene, {-2, 0, 2}, {2, 0, 2}, {2, 0, -1}, {-2, 0, -1}, 1);
  addQuad(scene, {-2, 0.2f, -1}, {2, 0.2f, -1}, {2, 0.2f, -2}, {-2, 0.2f, -2}, 1);
  addQuad(scene, {-2, 0, -1}, {2, 0, -1}, {2, 0.2f, -1}, {-2, 0.2f, -1}, 1);
  addTriangle(scene, {0, 4, 0}, {0.01f, 4, 0}, {0, 4, 0.01f}, 1);
  const Camera camera = lookAt({0, 0.6f, 2}, {0, 1, 0.3f});
  const Frame exact = draw(scene, camera, settingsWith({{"trace.method", "exact"}}), 120, 80);
  Settings settings = settingsWith({});
  applyPreset(settings, "kastrati2017");
  set(settings, "search.steps", "0");
  set(settings, "voxels.raster", "abuffer");
  set(settings, "voxels.resolution", "16");
  set(settings, "abuffer.resolution", "512");
  const Frame frame = draw(scene, camera, settings, 120, 80);
  int walls = 0, passed = 0;
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 120; ++x) {
      if (std::abs(exact.at(x, y, "hit.nz")) < 0.9f) continue;
      ++walls;
      passed += std::abs(frame.at(x, y, "hit.T") - exact.at(x, y, "hit.T")) > 0.05f ? 1 : 0;
    }
  EXPECT_GT(walls, 80);
  EXPECT_LE(passed, walls / 20);
}

// A single-sided plane whose back the rays see: invisible to them, however a method searches.
TEST_F(TracingTest, BacksOfSingleSidedPlanesAreInvisibleToEveryMethod) {
  Scene scene;
  scene.materials = {mirrorMaterial(), plain({1, 1, 1})};
  addQuad(scene, {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}, 0);
  addQuad(scene, {-1, 0.7f, 1}, {1, 0.7f, 1}, {1, 0.7f, -1}, {-1, 0.7f, -1}, 1);  // faces up, away from the mirror
  const Camera camera = lookAt({0, 0.4f, 3}, {0, 0, 0.5f});
  for (const char* preset : {"halfsilver", "bvh", "burger2007", "kastrati2017", "hu2014", "reference"}) {
    Settings settings = settingsWith({});
    applyPreset(settings, preset);
    set(settings, "select.mode", "reflective");
    set(settings, "abuffer.resolution", "256");
    const Frame frame = draw(scene, camera, settings, 80, 60);
    EXPECT_GT(frame.report.selected, 500u);
    int hits = 0;
    for (const float t : frame.plane("hit.T")) hits += t >= 0 ? 1 : 0;
    EXPECT_EQ(hits, 0) << preset;
  }
}

// Pages under contention: many sheets over the same texels are all stored, in every page size.
TEST_F(TracingTest, PagesOfManySheetsAreComplete) {
  const int sheets = 300;
  const Scene scene = manySheets(sheets);
  for (const char* pageSize : {"1", "3", "4", "64"}) {
    Settings settings = settingsWith({});
    applyPreset(settings, "kastrati2017");
    for (const auto& [name, value] : {std::pair("abuffer.page_size", pageSize), std::pair("abuffer.resolution", "16"),
                                      std::pair("voxels.resolution", "4")})
      set(settings, name, value);
    const Frame frame = draw(scene, kBelowSheets, settings, 40, 30);
    EXPECT_EQ(frame.report.lostFragments, 0u) << pageSize;
    EXPECT_EQ(frame.report.overflow, 0u) << pageSize;
    EXPECT_EQ(frame.report.memory.fragmentsStored, static_cast<std::uint64_t>(16 * 16 * (sheets + 1))) << pageSize;
  }
}

// A pool that is too small is counted and shown, never a miss in silence; the next frames have room.
TEST_F(TracingTest, LostFragmentsAreOverflowNotMisses) {
  const Scene scene = manySheets(120);
  Settings settings = settingsWith({});
  applyPreset(settings, "kastrati2017");
  set(settings, "abuffer.resolution", "64");
  set(settings, "voxels.resolution", "16");
  const Frame first = drawOnce(scene, kBelowSheets, settings, 40, 30);
  ASSERT_GT(first.report.lostFragments, 0u);
  EXPECT_GT(first.report.overflow, 0u);
  const Frame later = draw(scene, kBelowSheets, settings, 40, 30);
  const std::vector<float> t = first.plane("hit.T"), whole = later.plane("hit.T");
  std::uint64_t shown = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (t[i] == -3.0f)
      ++shown;
    else
      ASSERT_EQ(t[i], whole[i]);
  }
  EXPECT_EQ(shown, first.report.overflow);
  EXPECT_EQ(later.report.lostFragments, 0u);
  EXPECT_EQ(later.report.overflow, 0u);
}

// Alpha cuts and back faces are the same rule for the rays of all exact methods.
TEST_F(TracingTest, RaysSeeHolesAndCulledBacksAsTheReferenceDoes) {
  Scene scene = soup(0);
  auto texture = std::make_shared<Texture>();
  texture->width = texture->height = 8;
  texture->srgb = true;
  for (int i = 0; i < 64; ++i) {
    const std::uint8_t alpha = ((i % 8) / 2 + (i / 16)) % 2 ? 255 : 0;
    texture->texels.insert(texture->texels.end(), {200, 120, 40, alpha});
  }
  scene.textures = {texture};
  Material leaf = plain({1, 1, 1});
  leaf.alphaMode = AlphaMode::mask;
  leaf.doubleSided = true;
  leaf.baseColorTexture.texture = 0;
  Material oneSided = plain({0, 1, 0});
  scene.materials.push_back(leaf);
  scene.materials.push_back(oneSided);
  addQuad(scene, {-1.5f, 0.2f, -1}, {0, 0.2f, -1}, {0, 1.4f, -1}, {-1.5f, 1.4f, -1}, 2);
  addQuad(scene, {1.5f, 0.2f, -1}, {0.2f, 0.2f, -1}, {0.2f, 1.4f, -1}, {1.5f, 1.4f, -1}, 3);  // its back to the rays
  addQuad(scene, {-1.9f, 0, -1.9f}, {1.9f, 0, -1.9f}, {1.9f, 1.9f, -1.9f}, {-1.9f, 1.9f, -1.9f}, 1);
  for (const char* cull : {"true", "false"}) {
    const Frame exact =
        draw(scene, kAbove, settingsWith({{"trace.method", "exact"}, {"scene.cull_back_faces", cull}}), 120, 90);
    const Frame frame = draw(scene, kAbove, settingsWith({{"scene.cull_back_faces", cull}}), 120, 90);
    const HitErrors errors = compareHits(frame, exact, scene.bounds().diagonal());
    EXPECT_EQ(errors.hitError, 0);
    std::set<float> ids;
    for (const float id : frame.plane("hit.id")) ids.insert(id);
    EXPECT_TRUE(ids.count(2) == 1 && ids.count(6) == 1);
    EXPECT_EQ(ids.count(4) + ids.count(5) > 0, std::string(cull) == "false");
  }
}

}  // namespace
}  // namespace halfsilver::testing
