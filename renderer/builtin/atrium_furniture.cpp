#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "builtin/atrium_parts.h"
#include "builtin/random.h"

// What hangs and stands in the atrium: banners and curtains, plants, the bronze knot, lanterns.
namespace halfsilver::atrium {
namespace {

using glm::dvec2;
using glm::dvec3;

// A banner that hangs from a rod; its front faces `out` (along x).
void addBanner(MeshBuilder& build, const Materials& m, std::uint32_t cloth, dvec3 top, double out, double width,
               double height, double phase) {
  build.use(cloth);
  build.surface(56, 16, {1, 1}, [&](double s, double t) {
    // Folds are sharp at the rod and fade toward the foot; the cloth sways a little.
    const double fold = std::sin(2 * kPi * 5 * s + phase) + 0.35 * std::sin(2 * kPi * 11 * s + 2 * phase + 2 * t);
    const double depth = 0.055 * (1 - 0.45 * t) * fold + 0.05 * std::sin(1.5 * kPi * t + phase) * t;
    const double side = (s - 0.5) * width * (1 + 0.04 * std::sin(3 * t + phase));
    return top + dvec3(out * (depth + 0.10), -height * t, -out * side);
  });
  build.use(m.bronze);
  const dvec3 rod = top + dvec3(out * 0.10, 0.02, 0), along(0, 0, 0.5 * width + 0.10);
  const std::array<dvec3, 2> ends{rod - along, rod + along};
  build.tube(ends, 0.022, 10, dvec3(0, 1, 0));
  for (const dvec3& end : ends) build.lathe(Profile().arc({0, 0}, 0.045, 0.5 * kPi, -0.5 * kPi, 8), end, 16);
}

// Half of a pair of curtains in an arch, gathered to the column at its side (side is +1 toward +z).
void addCurtain(MeshBuilder& build, std::uint32_t cloth, dvec3 top, double side, double width, double phase) {
  build.use(cloth);
  build.surface(64, 20, {1.5, 2.0}, [&](double s, double t) {
    // Seen from the nave (smaller x), s runs to the right, that is along +z.
    const double across = side > 0 ? 1 - s : s;  // 0 at the column, 1 in the middle of the arch
    const double tied = 0.62;
    const double gather =
        t < tied ? 1 - 0.80 * std::pow(std::max(t, 0.0) / tied, 1.6) : 0.20 + 0.30 * (t - tied) / (1 - tied);
    const double sag = 0.42 * across * across * std::sin(kPi * std::min(1.0, t / tied)) * (1 - gather);
    const double folds = std::sin(2 * kPi * 7 * across + phase) + 0.3 * std::sin(2 * kPi * 15 * across + 3 * phase);
    const double depth = (0.035 + 0.05 * (1 - gather)) * folds;
    const double y = -3.25 * t - sag;
    return top + dvec3(depth, std::max(y, -3.52), -side * width * across * gather);
  });
}

// A sprig of leaves: a card that bends along its length and is folded along its stem.
void addSprig(MeshBuilder& build, dvec3 root, dvec3 direction, dvec3 side, double length, double width, double droop) {
  const dvec3 face = glm::normalize(glm::cross(side, direction));
  build.surface(2, 3, {1, 1}, [&](double s, double t) {
    const double along = 1 - t, across = 2 * s - 1;
    const dvec3 bend = dvec3(0, -droop * length * along * along, 0);
    return root + length * along * direction + 0.5 * width * across * side +
           0.10 * width * std::sqrt(across * across + 0.01) * face + bend;
  });
}

// Ivy that hangs over the gallery's edge in tufts.
void addIvy(MeshBuilder& build, const Materials& m, double out, std::uint32_t seed) {
  Random random(seed);
  for (int tuft = 0; tuft < 22; ++tuft) {
    const double middle = random.between(-kHalfLength + 0.6, kHalfLength - 0.6), spread = random.between(0.3, 1.0);
    const double longest = random.between(0.3, 1.15);
    const int sprigs = static_cast<int>(22 * spread);
    for (int i = 0; i < sprigs; ++i) {
      const double at = random.between(-1, 1);
      const double drop = longest * (1 - at * at) * random.unit();
      const dvec3 root(out * (kArcadeFace - 0.17 - random.between(0, 0.10)), kGallery + 0.08 - drop,
                       std::clamp(middle + spread * at, 0.2 - kHalfLength, kHalfLength - 0.2));
      const double along = random.between(-0.5, 0.5), down = random.between(0.4, 1.0);
      const dvec3 direction = glm::normalize(dvec3(-out * random.between(0.15, 0.5), -down, along));
      const dvec3 side = glm::normalize(glm::cross(direction, dvec3(-out, 0.2, 0)));
      const float bright = static_cast<float>(random.between(0.7, 1.2));
      build.use(m.leaves, 1, glm::vec4(bright * 0.8f, bright, bright * 0.8f, 1));
      const double width = random.between(0.24, 0.36), length = random.between(0.26, 0.42);
      addSprig(build, root, direction, side, length, width, 0.15);
    }
  }
}

}  // namespace

void addDrapes(MeshBuilder& build, const Materials& m) {
  const std::array<std::uint32_t, 4> cloths{m.drapeRed, m.drapeTeal, m.drapeGold, m.drapeRed};
  for (int i = 0; i < 4; ++i) {
    const double z = columnZ(2 * i + 1);
    const auto at = static_cast<std::size_t>(i);
    for (const double side : {-1.0, 1.0})
      addBanner(build, m, cloths[at], {side * 3.02, 9.25, z}, -side, 1.25, 3.75, 1.7 * i + side);
  }
  for (const int bay : {2, 5})
    for (const double wall : {-1.0, 1.0})
      for (const double side : {-1.0, 1.0})
        addCurtain(build, bay == 2 ? m.drapeTeal : m.drapeRed, {wall * kColumnAxis, 3.56, bayZ(bay) + side * 1.42},
                   side, 1.40, 0.9 * bay + side + 2 * wall);
  build.use(m.bronze);
  for (const int bay : {2, 5})
    for (const double wall : {-1.0, 1.0}) {
      const std::array<dvec3, 2> rod{dvec3(wall * kColumnAxis, 3.57, bayZ(bay) - 1.46),
                                     dvec3(wall * kColumnAxis, 3.57, bayZ(bay) + 1.46)};
      build.tube(rod, 0.02, 10, dvec3(0, 1, 0));
    }
}

void addPottedPlant(MeshBuilder& build, const Materials& m, dvec3 base, std::uint32_t seed) {
  Random random(seed);
  build.use(m.terracotta, 0.8);
  Profile pot;
  pot.lines({{0.36, 0.60}, {0.38, 0.70}, {0.43, 0.70}}).arc({0.43, 0.67}, 0.03, 0.5 * kPi, -0.5 * kPi, 4);
  pot.lines({{0.43, 0.64}, {0.40, 0.62}});
  std::vector<dvec2> belly;
  for (int i = 0; i <= 8; ++i) {
    const double t = i / 8.0;
    belly.emplace_back(0.40 - 0.14 * t * t + 0.03 * std::sin(kPi * t), 0.62 - 0.54 * t);
  }
  pot.curve(belly).lines({{0.26, 0.08}, {0.30, 0.08}}).arc({0.30, 0.04}, 0.04, 0.5 * kPi, -0.5 * kPi, 4);
  build.lathe(pot, base, 36);
  build.use(m.soil);
  build.disc(base + dvec3(0, 0.62, 0), {0, 1, 0}, 0.37, 32);
  for (int i = 0; i < 110; ++i) {
    const double turn = random.between(0, 2 * kPi), lift = random.between(-0.1, 1.35);
    const dvec3 outwards(std::cos(turn), 0, std::sin(turn));
    const dvec3 direction = std::cos(lift) * outwards + dvec3(0, std::sin(lift), 0);
    const double ring = random.between(0.02, 0.30), height = random.between(0.65, 1.45);
    const double tilt = random.between(-0.5, 0.5);
    const dvec3 level(-outwards.z, 0, outwards.x), above = glm::cross(level, direction);
    const float bright = static_cast<float>(random.between(0.75, 1.25));
    build.use(m.leaves, 1, glm::vec4(bright * 0.95f, bright, bright * 0.85f, 1));
    const double bend = random.between(0.1, 0.45), width = random.between(0.34, 0.48);
    const double length = random.between(0.38, 0.62);
    addSprig(build, base + ring * outwards + dvec3(0, height, 0), direction,
             std::cos(tilt) * level + std::sin(tilt) * above, length, width, bend);
  }
}

void addPlants(MeshBuilder& build, const Materials& m) {
  std::uint32_t seed = 200;
  for (const int bay : {0, 1, 3, 4, 6, 7})
    for (const double side : {-1.0, 1.0}) addPottedPlant(build, m, {side * kColumnAxis, 0, bayZ(bay)}, seed++);
  for (const double side : {-1.0, 1.0}) addIvy(build, m, side, seed++);
}

void addCentrepiece(MeshBuilder& build, const Materials& m) {
  const dvec3 base(0, 0, columnZ(4));
  build.use(m.limestone, kPlainScale);
  Profile pedestal;
  pedestal.lines({{0, 1.30}, {0.52, 1.30}}).arc({0.52, 1.26}, 0.04, 0.5 * kPi, -0.5 * kPi, 8);
  pedestal.lines({{0.52, 1.22}, {0.48, 1.22}}).arc({0.48, 1.14}, 0.08, 0.5 * kPi, kPi, 6);
  pedestal.lines({{0.40, 1.14}, {0.40, 0.56}}).arc({0.50, 0.56}, 0.10, kPi, 1.5 * kPi, 8);
  pedestal.lines({{0.50, 0.46}, {0.56, 0.46}}).arc({0.56, 0.40}, 0.06, 0.5 * kPi, -0.5 * kPi, 10);
  pedestal.lines({{0.56, 0.34}, {0.74, 0.34}, {0.74, 0.18}, {0.98, 0.18}, {0.98, 0}});
  build.lathe(pedestal, base, 72);
  build.use(m.verde, kPlainScale);
  build.lathe(Profile().lines({{0.40, 1.02}, {0.415, 1.02}, {0.415, 0.68}, {0.40, 0.68}}), base, 72);

  // A (2, 3) torus knot; the ring's plane is upright and faces the hall.
  build.use(m.bronze);
  const dvec3 center = base + dvec3(0, 2.42, 0);
  constexpr double kRing = 0.66, kWind = 0.29, kBar = 0.155;
  const auto axisAt = [&](double u) {
    const double angle = 2 * kPi * u;
    const double radius = kRing + kWind * std::cos(3 * angle);
    return center + dvec3(radius * std::sin(2 * angle), radius * std::cos(2 * angle), kWind * std::sin(3 * angle));
  };
  build.surface(256, 24, {12, 1}, [&](double s, double t) {
    const dvec3 at = axisAt(s), along = glm::normalize(axisAt(s + 1e-4) - axisAt(s - 1e-4));
    // The ring's own radius serves as reference: it never runs along the bar.
    const double angle = 4 * kPi * s;
    const dvec3 reference(std::sin(angle), std::cos(angle), 0);
    const dvec3 a = glm::normalize(reference - along * glm::dot(reference, along)), b = glm::cross(a, along);
    const double around = -2 * kPi * t;
    return at + kBar * (std::cos(around) * a + std::sin(around) * b);
  });
}

void addLantern(MeshBuilder& build, const Materials& m, double z) {
  MeshBuilder lantern;
  constexpr int kSides = 6;
  constexpr double kWide = 0.24, kNarrow = 0.17, kHigh = 0.62;
  const auto corner = [&](int i, double radius, double y) {
    const double angle = 2 * kPi * i / kSides;
    return dvec3(radius * std::sin(angle), y, radius * std::cos(angle));
  };
  for (int i = 0; i < kSides; ++i) {
    lantern.use(m.glass);
    const dvec3 a = corner(i, kWide, kHigh), b = corner(i, kNarrow, 0), c = corner(i + 1, kNarrow, 0),
                d = corner(i + 1, kWide, kHigh);
    lantern.grid(1, 1, [&](int column, int row) {
      SurfacePoint p;
      p.position = column == 0 ? (row == 0 ? a : b) : (row == 0 ? d : c);
      p.normal = glm::cross(b - a, d - a);
      p.tangent = d - a;
      p.uv = dvec2(column, row);
      return p;
    });
    lantern.use(m.iron);
    const std::array<dvec3, 2> post{a, b}, top{a, d}, bottom{b, c};
    lantern.tube(post, 0.016, 6, dvec3(0, 1, 0.7));
    lantern.tube(top, 0.018, 6, dvec3(0, 1, 0));
    lantern.tube(bottom, 0.018, 6, dvec3(0, 1, 0));
  }
  lantern.use(m.iron);
  std::vector<dvec2> roof;
  for (int i = 0; i <= 10; ++i) {
    const double t = i / 10.0;
    roof.emplace_back(0.03 + 0.25 * t * t, kHigh + 0.34 - 0.32 * t);
  }
  Profile cap;
  cap.arc({0, kHigh + 0.40}, 0.05, 0.5 * kPi, -0.3 * kPi, 8).curve(roof);
  cap.lines({{0.28, kHigh + 0.02}, {0.28, kHigh}, {0, kHigh}});
  lantern.lathe(cap, dvec3(0), 24);
  lantern.lathe(Profile().lines({{0, 0.02}, {kNarrow, 0.02}, {kNarrow, -0.02}}).arc({0, -0.02}, 0.05, 0, -0.5 * kPi, 6),
                dvec3(0), 24);
  const std::array<dvec3, 2> rod{dvec3(0, kHigh + 0.42, 0), dvec3(0, kRoof + kRibRadius - 0.42 - kLanternFoot, 0)};
  lantern.tube(rod, 0.012, 6, dvec3(1, 0, 0));
  build.append(lantern.mesh(), {{0, kLanternFoot, z}, 0});
}

void addLanterns(MeshBuilder& build, const Materials& m) {
  for (const double z : kLanternZ) addLantern(build, m, z);
}

}  // namespace halfsilver::atrium
