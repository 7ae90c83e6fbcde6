#include <array>
#include <cmath>
#include <vector>

#include "builtin/game_parts.h"

// The atrium with fewer triangles, and what there is to roll over in it.
namespace halfsilver::game {
namespace {

using namespace atrium;
using glm::dvec2;
using glm::dvec3;

constexpr int kArchSegments = 14;

Profile band(double radius, double width) {
  return Profile().lines(
      {{0, radius + width}, {0.06, radius + width}, {0.06, radius + 0.6 * width}, {0.03, radius}, {0, radius}});
}

void addVault(MeshBuilder& build, const atrium::Materials& m, double z) {
  // Two barrels that cross, over one bay of the aisle.
  constexpr int kSteps = 10;
  const dvec3 center(0.5 * (kArcadeBack + kOuterWall), kSpringing, z);
  const double halfX = 0.5 * (kOuterWall - kArcadeBack), halfZ = 0.5 * kBay, height = 1.45;
  build.use(m.vault, kPlainScale);
  for (const dvec3& outwards : {kX, -kX, kZ, -kZ}) {
    const dvec3 across = glm::cross(outwards, kY);
    const bool alongX = std::abs(outwards.x) > 0.5;
    const double reach = alongX ? halfX : halfZ, width = alongX ? halfZ : halfX;
    build.grid(kSteps, 1, [&](int column, int row) {
      const double angle = kPi * column / kSteps, at = -std::cos(angle), rise = std::sin(angle);
      const double out = row == 0 ? std::abs(at) : 1.0;
      SurfacePoint p;
      p.position = center + reach * out * outwards + width * at * across + height * rise * kY;
      p.normal = -(at / width) * across - (rise / height) * kY;
      p.tangent = rise * width * across - at * height * kY;
      p.uv = dvec2(width * angle, reach * out) / kPlainScale;
      return p;
    });
  }
}

void addBay(MeshBuilder& build, const atrium::Materials& m, double z) {
  const dvec3 face(kArcadeFace, kSpringing, z), back(kArcadeBack, kSpringing, z);
  const double wall = kGallery - 0.25 - kSpringing, upperWall = kCeiling - kUpperSpringing;
  build.use(m.stone, kStoneScale);
  build.archedWall(face, kZ, kY, 0.5 * kBay, wall, kArchRadius, kArchSegments);
  build.archedWall(back, -kZ, kY, 0.5 * kBay, wall, kArchRadius, kArchSegments);
  for (const double shift : {-0.25 * kBay, 0.25 * kBay}) {
    const dvec3 upper(kUpperFace, kUpperSpringing, z + shift);
    build.use(m.stone, kStoneScale);
    build.archedWall(upper, kZ, kY, 0.25 * kBay, upperWall, kUpperRadius, kArchSegments);
    build.use(m.limestone, kPlainScale);
    build.sweepArc(soffit(kUpperRadius, kUpperBack - kUpperFace), upper, -kX, -kZ, kPi, kArchSegments);
    build.sweepArc(band(kUpperRadius, 0.15), upper, -kX, -kZ, kPi, kArchSegments);
  }
  build.use(m.limestone, kPlainScale);
  build.sweepArc(soffit(kArchRadius, kArcadeBack - kArcadeFace), face, -kX, -kZ, kPi, kArchSegments);
  build.sweepArc(band(kArchRadius, 0.27), face, -kX, -kZ, kPi, kArchSegments);
  build.box({kArcadeFace - 0.1, kSpringing + kArchRadius - 0.03, z - 0.13},
            {kArcadeFace + 0.1, kSpringing + kArchRadius + 0.37, z + 0.13});
  addVault(build, m, z);
  build.use(m.limestone, kPlainScale);
  build.box({kOuterWall - 0.07, 0, z - 1.5}, {kOuterWall + 0.1, 1.05, z + 1.5}, kAllFaces & ~kFaceRight & ~kFaceBottom);
  build.use(m.verde, kPlainScale);
  for (const double shift : {-0.98, 0.0, 0.98})
    build.box({kOuterWall - 0.09, 0.2, z + shift - 0.4}, {kOuterWall, 0.86, z + shift + 0.4},
              kAllFaces & ~kFaceRight & ~kFaceBottom);
}

Mesh column(const atrium::Materials& m, bool upper) {
  MeshBuilder build;
  build.use(m.limestone, kPlainScale);
  const double plinth = upper ? 0.18 : 0.47, height = upper ? 2.45 : kSpringing;
  const double foot = upper ? 0.14 : 0.22, shaft = upper ? 0.13 : 0.32, cap = upper ? 0.15 : 0.16;
  build.box({-plinth, 0, -plinth}, {plinth, foot, plinth}, kAllFaces & ~kFaceBottom);
  const double top = height - cap, bell = upper ? 0.22 : 0.46;
  std::vector<dvec2> body;
  for (int i = 0; i <= 4; ++i) {
    const double t = 1 - i / 4.0;
    body.emplace_back(shaft * (1 + 0.32 * t * t * t), top - bell * (1 - t));
  }
  Profile p;
  p.curve(body)
      .lines({{shaft, top - bell}, {1.14 * shaft, top - bell}})
      .arc({1.14 * shaft, top - bell - 0.1 * shaft}, 0.1 * shaft, 0.5 * kPi, -0.5 * kPi, 4);
  p.lines({{1.14 * shaft, top - bell - 0.2 * shaft},
           {0.92 * shaft, top - bell - 0.2 * shaft},
           {shaft, foot + 0.8 * shaft}});
  p.arc({shaft, foot + 0.5 * shaft}, 0.3 * shaft, 0.5 * kPi, -0.5 * kPi, 5);
  p.lines({{shaft, foot + 0.2 * shaft}, {1.36 * shaft, foot + 0.2 * shaft}, {1.36 * shaft, foot}});
  build.lathe(p, dvec3(0), upper ? 12 : 20);
  const double slab = upper ? 0.21 : 0.45;
  build.box({-slab, top, -slab}, {slab, height, slab});
  return build.take();
}

void addSide(MeshBuilder& build, const atrium::Materials& m) {
  for (int k = 0; k < kBays; ++k) addBay(build, m, bayZ(k));
  const Mesh lower = column(m, false), upper = column(m, true);
  for (int k = 1; k < kBays; ++k) {
    const double z = columnZ(k);
    build.append(lower, {{kColumnAxis, 0, z}, 0});
    build.use(m.limestone, kPlainScale);
    build.box({kOuterWall - 0.2, 0, z - 0.3}, {kOuterWall + 0.1, kSpringing, z + 0.3});
    const dvec3 center(kArcadeFace, 5.08, z);
    build.use(m.verde, kPlainScale).disc(center - 0.012 * kX, -kX, 0.25, 20);
  }
  for (int k = 1; k < 2 * kBays; ++k) build.append(upper, {{kColumnAxis, kGallery, -kHalfLength + 0.5 * kBay * k}, 0});
  const double length = 2 * kHalfLength;
  addShell(build, m);
  build.use(m.railing);
  for (const double y : {0.10, 0.5, 0.9})
    build.box({3.20, kGallery + y, -kHalfLength}, {3.24, kGallery + y + 0.04, kHalfLength});
  build.use(m.limestone, kPlainScale);
  Profile course;
  course.lines({{0, 0.30}, {0.17, 0.30}, {0.17, 0.24}, {0.10, 0.16}, {0.08, 0.06}, {0, 0}});
  build.extrude(course, {kArcadeFace, kGallery - 0.3, -kHalfLength}, -kX, kY, length);
  Profile cornice;
  cornice.lines(
      {{0, 0.62}, {0.38, 0.62}, {0.38, 0.54}, {0.24, 0.44}, {0.20, 0.38}, {0.08, 0.38}, {0.08, 0.12}, {0, 0}});
  build.extrude(cornice, {kUpperFace - 0.005, kCeiling - 0.05, -kHalfLength}, -kX, kY, length);
}

void addEnd(MeshBuilder& build, const atrium::Materials& m) {
  constexpr double kDoor = 1.5, kDoorSpringing = 2.7, kThick = 0.6;
  const double front = -kHalfLength, half = kArcadeFace;
  build.use(m.stone, kStoneScale);
  for (const double side : {-1.0, 1.0}) {
    const auto across = [&](double a, double b, double height) {
      build.box({std::min(side * a, side * b), 0, front - kThick}, {std::max(side * a, side * b), height, front});
    };
    across(half, kOuterWall + 0.4, kRoof);
    across(kDoor, half, kDoorSpringing);
  }
  build.archedWall({0, kDoorSpringing, front}, kX, kY, half, kRoof - kDoorSpringing, kDoor, 24);
  build.box({-half, kDoorSpringing, front - kThick}, {half, kRoof, front - kThick + 0.1}, kFaceBack);
  build.use(m.limestone, kPlainScale);
  build.sweepArc(soffit(kDoor, kThick), {0, kDoorSpringing, front}, kZ, -kX, kPi, 24);
  build.sweepArc(band(kDoor, 0.34), {0, kDoorSpringing, front}, kZ, -kX, kPi, 24);
  for (const double side : {-1.0, 1.0}) {
    build.box({side * (kDoor + 0.17) - 0.17, 0, front}, {side * (kDoor + 0.17) + 0.17, kDoorSpringing, front + 0.08});
    build.box({side * 3.6 - 0.45, 0, front}, {side * 3.6 + 0.45, kSpringing, front + 0.3});
    build.box({side * 3.6 - 0.22, kGallery, front}, {side * 3.6 + 0.22, kUpperSpringing, front + 0.18});
  }
  Profile course;
  course.lines({{0, 0.30}, {0.17, 0.30}, {0.17, 0.24}, {0.08, 0.12}, {0, 0}});
  build.extrude(course, {-half, kGallery - 0.3, front}, kZ, kY, 2 * half);
  build.extrude(course, {-half, kRoof - 0.32, front}, kZ, kY, 2 * half);
  build.use(m.wood, 0.8);
  build.box({-kDoor - 0.05, 0, front - 0.5}, {kDoor + 0.05, kDoorSpringing + kDoor + 0.05, front - 0.35}, kFaceFront);
  for (const double side : {-1.0, 1.0})
    for (const double y : {0.15, 1.4, 2.65})
      build.box({side * 0.75 - 0.55, y, front - 0.35}, {side * 0.75 + 0.55, y + 1.0, front - 0.30},
                kAllFaces & ~kFaceBack);
  build.use(m.iron).box({-0.03, 0, front - 0.36}, {0.03, 4.2, front - 0.29}, kAllFaces & ~kFaceBack);
}

void addRibs(MeshBuilder& build, const atrium::Materials& m) {
  build.use(m.iron);
  std::vector<dvec3> points(17);
  const auto on = [](double angle, double z) {
    return dvec3(-kRibRadius * std::cos(angle), kRoof + kRibRadius * std::sin(angle), z);
  };
  for (int k = 0; k <= kBays; ++k) {
    for (int i = 0; i <= 16; ++i) points[static_cast<std::size_t>(i)] = on(kPi * i / 16, columnZ(k));
    build.tube(points, 0.09, 5, kZ);
  }
  for (int i = 1; i < 6; ++i) {
    const dvec3 from = on(kPi * i / 6, -kHalfLength);
    const std::array<dvec3, 2> purlin{from, from + 2 * kHalfLength * kZ};
    build.tube(purlin, 0.05, 5, kX + kY);
  }
}

void addBanners(MeshBuilder& build, const atrium::Materials& m) {
  const std::array<std::uint32_t, 4> cloths{m.drapeRed, m.drapeTeal, m.drapeGold, m.drapeRed};
  for (int i = 0; i < 4; ++i)
    for (const double side : {-1.0, 1.0}) {
      const dvec3 top(side * 3.0, 9.25, columnZ(2 * i + 1));
      const double phase = 1.7 * i + side;
      build.use(cloths[static_cast<std::size_t>(i)]).surface(24, 5, {1, 1}, [&](double s, double t) {
        const double depth = 0.06 * (1 - 0.45 * t) * std::sin(2 * kPi * 4 * s + phase) + 0.05 * t * std::sin(phase);
        return top + dvec3(-side * (depth + 0.10), -3.75 * t, side * (s - 0.5) * 1.3);
      });
    }
}

// The atrium's bronze knot on its pedestal.
void addKnot(MeshBuilder& build, const atrium::Materials& m) {
  Profile pedestal;
  pedestal.lines({{0, 1.30},
                  {0.55, 1.30},
                  {0.55, 1.22},
                  {0.48, 1.22},
                  {0.40, 1.10},
                  {0.40, 0.52},
                  {0.56, 0.46},
                  {0.60, 0.34},
                  {0.74, 0.34},
                  {0.74, 0.18},
                  {0.98, 0.18},
                  {0.98, 0}});
  build.use(m.limestone, kPlainScale).lathe(pedestal, dvec3(0), 32);
  constexpr double kRing = 0.66, kWind = 0.29, kBar = 0.155;
  const auto axisAt = [&](double u) {
    const double angle = 2 * kPi * u, radius = kRing + kWind * std::cos(3 * angle);
    return dvec3(radius * std::sin(2 * angle), 2.42 + radius * std::cos(2 * angle), kWind * std::sin(3 * angle));
  };
  build.use(m.bronze).surface(112, 10, {12, 1}, [&](double s, double t) {
    const dvec3 at = axisAt(s), along = glm::normalize(axisAt(s + 1e-4) - axisAt(s - 1e-4));
    const dvec3 reference(std::sin(4 * kPi * s), std::cos(4 * kPi * s), 0);
    const dvec3 a = glm::normalize(reference - along * glm::dot(reference, along)), b = glm::cross(a, along);
    return at + kBar * (std::cos(-2 * kPi * t) * a + std::sin(-2 * kPi * t) * b);
  });
}

// A wedge along z: level at `height` from z = top on, down to the floor at z = foot.
void addRamp(MeshBuilder& build, double x0, double x1, double foot, double top, double height) {
  const double forward = top < foot ? 1 : -1;  // whether it rises toward -z
  const dvec3 a(forward > 0 ? x0 : x1, 0, foot), right = (x1 - x0) * forward * kX;
  const dvec3 up(0, height, top - foot);
  build.rectangle(a + up, right, -up);
  for (const double x : {x0, x1}) {
    const dvec3 low(x, 0, foot), under(x, 0, top), high(x, height, top);
    const bool flip = (x == x1) != (forward > 0);
    const dvec3 normal = x == x0 ? -kX : kX;
    const auto corner = [&](dvec3 p) { return build.vertex({p, normal, kZ, dvec2(p.z, -p.y) / kPlainScale}); };
    const std::uint32_t first = corner(low), second = corner(flip ? high : under), third = corner(flip ? under : high);
    build.triangle(first, second, third);
  }
}

}  // namespace

void addHall(MeshBuilder& build, const Materials& materials) {
  const atrium::Materials& m = materials.hall;
  addFloor(build, m);
  MeshBuilder side, end;
  addSide(side, m);
  addEnd(end, m);
  for (const double turn : {0.0, kPi}) {
    build.append(side.mesh(), {dvec3(0), turn});
    build.append(end.mesh(), {dvec3(0), turn});
  }
  addRibs(build, m);
  addBanners(build, m);
  addKnot(build, m);
  for (int i = 0; i < kLanterns; ++i) {
    atrium::Materials lit = m;
    lit.glass = materials.lanterns[i];
    addLantern(build, lit, kLanternZ[i]);
  }
}

void addObstacles(MeshBuilder& build, const Materials& materials) {
  const atrium::Materials& m = materials.hall;
  const auto block = [&](dvec3 low, dvec3 high) { build.box(low, high, kAllFaces & ~kFaceBottom); };
  // Two low steps.
  build.use(m.limestone, kPlainScale);
  block({-1.9, 0, 3.9}, {-0.2, 0.1, 6.9});
  build.use(m.verde, kPlainScale);
  block({-1.6, 0.1, 4.4}, {-0.5, 0.2, 6.4});
  build.use(m.limestone, kPlainScale);
  // A bridge.
  addRamp(build, 0.9, 2.5, 7.2, 5.4, 0.36);
  addRamp(build, 0.9, 2.5, 2.4, 4.2, 0.36);
  block({0.9, 0, 4.2}, {2.5, 0.36, 5.4});
  // Two blocks in the aisle, between which a platform goes.
  for (const double end : {1.0, -1.0}) {
    addRamp(build, 4.5, 6.3, end * 7.9, end * 5.6, 0.5);
    block({4.5, 0, std::min(end * 3.6, end * 5.6)}, {6.3, 0.5, std::max(end * 3.6, end * 5.6)});
  }
  // A high one, to be reached by the lift, and the long way down.
  block({-6.3, 0, 0.8}, {-4.5, 1.0, 4.2});
  addRamp(build, -6.3, -4.5, -4.6, 0.8, 1.0);
}

}  // namespace halfsilver::game
