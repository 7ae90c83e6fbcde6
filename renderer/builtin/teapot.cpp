#include <array>
#include <cmath>

#include "builtin/parts.h"

// Martin Newell's teapot (1975, public domain) from its bicubic Bezier patches: 32 of them, of which 24 lie on
// surfaces of (nearly) revolution, so that a profile and the quarter circle's 0.56 give their control points. Handle
// and spout are given as half rings and mirrored. The original rounds one of the lid's 0.448 to 0.45.
namespace halfsilver {
namespace {

using glm::dvec2;
using glm::dvec3;

using Curve = std::array<dvec2, 4>;
using Patch = std::array<std::array<dvec3, 4>, 4>;  // [row][column]; rows run down, columns to the right

// (distance from the axis, height), from the top down.
constexpr std::array<Curve, 6> kProfiles{{
    {{{0, 3.15}, {0.8, 3.15}, {0, 2.85}, {0.2, 2.7}}},                 // knob
    {{{0.2, 2.7}, {0.4, 2.55}, {1.3, 2.55}, {1.3, 2.4}}},              // lid
    {{{1.4, 2.4}, {1.3375, 2.53125}, {1.4375, 2.53125}, {1.5, 2.4}}},  // rim
    {{{1.5, 2.4}, {1.75, 1.875}, {2, 1.35}, {2, 0.9}}},                // body
    {{{2, 0.9}, {2, 0.45}, {1.5, 0.225}, {1.5, 0.15}}},                // body
    {{{1.5, 0.15}, {1.5, 0.075}, {1.425, 0}, {0, 0}}},                 // bottom
}};

// A ring of four control points of a half: (x, y) on the plane of symmetry at one end, half the width, (x, y) at the
// other end.
struct HalfRing {
  dvec2 from;
  double halfWidth;
  dvec2 to;
};

constexpr std::array<HalfRing, 7> kHandle{{
    {{-1.6, 2.025}, 0.3, {-1.5, 2.25}},
    {{-2.3, 2.025}, 0.3, {-2.5, 2.25}},
    {{-2.7, 2.025}, 0.3, {-3, 2.25}},
    {{-2.7, 1.8}, 0.3, {-3, 1.8}},
    {{-2.7, 1.575}, 0.3, {-3, 1.35}},
    {{-2.5, 1.125}, 0.3, {-2.65, 0.9375}},
    {{-2, 0.9}, 0.3, {-1.9, 0.6}},
}};

constexpr std::array<HalfRing, 7> kSpout{{
    {{1.7, 1.425}, 0.66, {1.7, 0.6}},
    {{2.6, 1.425}, 0.66, {3.1, 0.825}},
    {{2.3, 2.1}, 0.25, {2.4, 2.025}},
    {{2.7, 2.4}, 0.25, {3.3, 2.4}},
    {{2.8, 2.475}, 0.25, {3.525, 2.49375}},
    {{2.9, 2.475}, 0.15, {3.45, 2.5125}},
    {{2.8, 2.4}, 0.15, {3.2, 2.4}},
}};

std::array<double, 4> bernstein(double t) {
  const double s = 1 - t;
  return {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
}

std::array<double, 4> bernsteinDerivative(double t) {
  const double s = 1 - t;
  return {-3 * s * s, 3 * s * s - 6 * s * t, 6 * s * t - 3 * t * t, 3 * t * t};
}

dvec3 combine(const Patch& patch, const std::array<double, 4>& rows, const std::array<double, 4>& columns) {
  dvec3 sum(0);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) sum += rows[i] * columns[j] * patch[i][j];
  return sum;
}

void addPatch(MeshBuilder& build, const Patch& patch, int steps) {
  build.grid(steps, steps, [&](int column, int row) {
    const double s = static_cast<double>(column) / steps, t = static_cast<double>(row) / steps;
    const auto bs = bernstein(s), bt = bernstein(t), ds = bernsteinDerivative(s), dt = bernsteinDerivative(t);
    SurfacePoint point;
    point.position = combine(patch, bt, bs);
    point.uv = dvec2(s, t);
    dvec3 across = combine(patch, bt, ds);
    const dvec3 down = combine(patch, dt, bs);
    // If a row shrinks to a point, the derivative along it vanishes in proportion to the mixed derivative.
    if (glm::length(across) < 1e-9) across = (row == 0 ? 1.0 : -1.0) * combine(patch, dt, ds);
    point.tangent = across;
    point.normal = glm::cross(down, across);
    return point;
  });
}

void addHalves(MeshBuilder& build, const std::array<HalfRing, 7>& rings, double scale, dvec3 base, int steps) {
  for (std::size_t part = 0; part < 2; ++part)
    for (const double side : {1.0, -1.0}) {
      Patch patch;
      for (std::size_t i = 0; i < 4; ++i) {
        const HalfRing& ring = rings[3 * part + i];
        std::array<dvec3, 4> points{dvec3(ring.to, 0), dvec3(ring.to, side * ring.halfWidth),
                                    dvec3(ring.from, side * ring.halfWidth), dvec3(ring.from, 0)};
        for (std::size_t j = 0; j < 4; ++j) patch[i][side > 0 ? j : 3 - j] = base + scale * points[j];
      }
      addPatch(build, patch, steps);
    }
}

}  // namespace

void addTeapot(MeshBuilder& build, double scale, dvec3 base, int steps) {
  constexpr double kArc = 0.56;
  constexpr std::array<dvec2, 4> kQuarter{dvec2(1, 0), dvec2(1, kArc), dvec2(kArc, 1), dvec2(0, 1)};
  for (const Curve& profile : kProfiles)
    for (int quarter = 0; quarter < 4; ++quarter) {
      Patch patch;
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j) {
          dvec2 around = kQuarter[j];  // along z, then x: to the right, seen from outside
          for (int turn = 0; turn < quarter; ++turn) around = dvec2(-around.y, around.x);
          patch[i][j] = base + scale * dvec3(profile[i].x * around.y, profile[i].y, profile[i].x * around.x);
        }
      addPatch(build, patch, steps);
    }
  addHalves(build, kHandle, scale, base, steps);
  addHalves(build, kSpout, scale, base, steps);
}

Model makeTeapotScene() {
  Model model;
  Scene& scene = model.scene;

  // The lid leaves a gap through which the inside shows.
  Material chrome = metal("mirror", glm::vec3(0.95f, 0.94f, 0.92f), 0.0f);
  chrome.doubleSided = true;
  const std::uint32_t mirror = addMaterial(scene, chrome);
  Material planks = dielectric("table", glm::vec3(1), 0.55f);
  const SurfaceTextures wood = woodPlanks();
  planks.baseColorTexture = addTexture(scene, wood.color);
  planks.normalTexture = addTexture(scene, wood.normal);
  const std::uint32_t table = addMaterial(scene, planks);
  Material cloth = dielectric("cloth", glm::vec3(1), 0.95f);
  cloth.baseColorTexture = addTexture(scene, checker(glm::vec3(0.93f, 0.91f, 0.86f), glm::vec3(0.72f, 0.16f, 0.14f)));
  const std::uint32_t mat = addMaterial(scene, cloth);
  const std::uint32_t teal = addMaterial(scene, dielectric("teal", glm::vec3(0.03f, 0.32f, 0.36f), 0.6f));
  const std::uint32_t lemon = addMaterial(scene, dielectric("lemon", glm::vec3(0.88f, 0.66f, 0.08f), 0.6f));
  const std::uint32_t coral = addMaterial(scene, dielectric("coral", glm::vec3(0.80f, 0.20f, 0.12f), 0.6f));
  const std::uint32_t leaf = addMaterial(scene, dielectric("leaf", glm::vec3(0.16f, 0.40f, 0.08f), 0.6f));
  const std::uint32_t plum = addMaterial(scene, dielectric("plum", glm::vec3(0.26f, 0.06f, 0.30f), 0.6f));
  const std::uint32_t cream = addMaterial(scene, dielectric("cream", glm::vec3(0.80f, 0.74f, 0.62f), 0.7f));

  MeshBuilder build;
  // A table top with a round mat; the teapot is as large as a person, so that meters suit it.
  build.use(table, 1.6).roundedBox({0, -0.2, 0}, {9.6, 0.2, 10}, 0.05, 3);
  build.use(mat, 0.5).disc({0, 0.03, 0}, {0, 1, 0}, 1.75, 96);
  build.lathe(Profile().lines({{1.75, 0.03}, {1.75, 0}}), dvec3(0), 96);
  build.use(mirror);
  addTeapot(build, 0.5, dvec3(0, 0.03, 0), 20);

  constexpr int kRound = 3;
  const auto ball = [&](std::uint32_t material, dvec3 base, double radius) {
    build.use(material).lathe(Profile().arc({0, 0}, radius, 0.5 * kPi, -0.5 * kPi, 24), base + dvec3(0, radius, 0), 48);
  };
  const auto cup = [&](std::uint32_t material, dvec3 base) {
    Profile bowl;
    bowl.lines({{0, 0.05}, {0.2, 0.05}}).arc({0.2, 0.2}, 0.15, -0.5 * kPi, 0, 8);
    bowl.lines({{0.35, 0.2}, {0.37, 0.55}, {0.42, 0.55}, {0.4, 0.2}}).arc({0.2, 0.2}, 0.2, 0, -0.5 * kPi, 10);
    bowl.lines({{0.2, 0}, {0, 0}});
    build.use(material).lathe(bowl, base, 48);
  };
  // Things in view.
  ball(lemon, {-1.9, 0, -1.5}, 0.42);
  ball(lemon, {-1.15, 0, -2.0}, 0.36);
  ball(coral, {2.35, 0, -1.1}, 0.4);
  cup(teal, {1.55, 0, 1.35});
  build.use(plum).roundedBox({1.0, 0, -2.4}, {1.5, 0.35, 1.0}, 0.05, kRound, 0.3);
  build.use(leaf).roundedBox({1.05, 0.35, -2.4}, {1.3, 0.28, 0.9}, 0.05, kRound, 0.05);
  build.use(teal).roundedBox({-2.9, 0, -0.2}, {0.8, 1.5, 0.8}, 0.06, kRound, 0.5);
  // Things that only the teapot shows: high boards around the camera, and smaller ones between.
  build.use(coral).roundedBox({-3.1, 0, 3.3}, {1.5, 2.7, 0.25}, 0.06, kRound, 0.75);
  build.use(cream).roundedBox({-1.2, 0, 3.8}, {1.4, 3.3, 0.25}, 0.06, kRound, 0.25);
  build.use(teal).roundedBox({3.9, 0, 2.4}, {1.4, 2.9, 0.25}, 0.06, kRound, -1.0);
  build.use(lemon).roundedBox({2.9, 0, 3.6}, {1.0, 2.2, 0.25}, 0.06, kRound, -0.55);
  build.use(leaf).roundedBox({-4.1, 0, 1.2}, {1.3, 2.4, 0.25}, 0.06, kRound, 1.25);
  build.use(plum).lathe(Profile().lines({{0, 1.5}, {0.3, 1.5}, {0.3, 0}}), dvec3(-0.15, 0, 4.6), 48);
  ball(coral, {-0.15, 1.5, 4.6}, 0.35);
  ball(plum, {3.7, 0, 0.6}, 0.45);
  cup(coral, {-2.9, 0, 2.0});
  setMesh(scene, build.take());

  scene.sky = clearSky();
  scene.lights.push_back(sunlight({-0.50f, -0.85f, -0.40f}, glm::vec3(1.0f, 0.94f, 0.84f), 7.0f));
  scene.cameras.push_back(lookAt("front", {0.9f, 2.1f, 4.6f}, {0.1f, 0.72f, 0}, 36));
  scene.cameras.push_back(lookAt("side", {-3.6f, 1.5f, 2.9f}, {0, 0.75f, 0}, 38));
  scene.cameras.push_back(lookAt("above", {1.4f, 4.2f, 2.6f}, {0, 0.6f, 0}, 40));
  return model;
}

}  // namespace halfsilver
