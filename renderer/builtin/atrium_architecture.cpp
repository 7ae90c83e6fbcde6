#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "builtin/atrium_parts.h"
#include "builtin/random.h"

// Walls, arches, vaults, roof and floor of the atrium.
namespace halfsilver::atrium {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr double kBrickScale = 1.3;

// A molded string course; out and down from (0, 0.3) at the wall.
Profile stringCourse() {
  Profile p;
  p.lines({{0, 0.30}, {0.17, 0.30}, {0.17, 0.24}}).arc({0.11, 0.24}, 0.06, 0, -0.5 * kPi, 6);
  p.lines({{0.11, 0.18}, {0.08, 0.18}, {0.08, 0.12}}).arc({0.08, 0.06}, 0.06, 0.5 * kPi, kPi, 6);
  p.lines({{0.02, 0.06}, {0.02, 0}, {0, 0}});
  return p;
}

// The molding around an arch: from the outer radius down to the opening.
Profile archivolt(double radius, double width) {
  Profile p;
  p.lines({{0, radius + width}, {0.07, radius + width}, {0.07, radius + 0.82 * width}});
  p.arc({0.07, radius + 0.70 * width}, 0.12 * width, 0.5 * kPi, 1.5 * kPi, 4);
  p.lines({{0.07, radius + 0.58 * width}, {0.05, radius + 0.58 * width}, {0.05, radius + 0.3 * width}});
  p.arc({0.05, radius + 0.2 * width}, 0.1 * width, 0.5 * kPi, -0.5 * kPi, 4);
  p.lines({{0.05, radius + 0.1 * width}, {0.03, radius + 0.1 * width}, {0.03, radius}, {0, radius}});
  return p;
}

// A plainer one, for small arches and those rarely seen.
Profile fascia(double radius, double width) {
  return Profile().lines({{0, radius + width},
                          {0.06, radius + width},
                          {0.06, radius + 0.7 * width},
                          {0.03, radius + 0.55 * width},
                          {0.03, radius},
                          {0, radius}});
}

// A bay's ceiling: two barrels of the same height that cross, springing from the four corners.
void addGroinVault(MeshBuilder& build, const Materials& m, dvec3 center, dvec2 half, double height) {
  constexpr int kSteps = 24;
  build.use(m.vault, kPlainScale);
  for (const dvec3& outwards : {kX, -kX, kZ, -kZ}) {
    const dvec3 across = glm::cross(outwards, kY);
    const bool alongX = std::abs(outwards.x) > 0.5;
    const double reach = alongX ? half.x : half.y, width = alongX ? half.y : half.x;
    build.grid(kSteps, 1, [&](int column, int row) {
      const double angle = kPi * column / kSteps;
      const double at = -std::cos(angle), rise = std::sin(angle);
      SurfacePoint p;
      const double out = row == 0 ? std::abs(at) : 1.0;
      p.position = center + reach * out * outwards + width * at * across + height * rise * kY;
      p.normal = -(at / width) * across - (rise / height) * kY;
      p.tangent = rise * width * across - at * height * kY;
      p.uv = dvec2(width * angle, reach * out) / kPlainScale;
      return p;
    });
  }
  build.use(m.limestone, kPlainScale);
  std::vector<dvec3> points(kSteps + 1);
  for (const double hand : {1.0, -1.0}) {
    for (int i = 0; i <= kSteps; ++i) {
      const double angle = kPi * i / kSteps;
      points[static_cast<std::size_t>(i)] =
          center + dvec3(-half.x * std::cos(angle), height * std::sin(angle), -hand * half.y * std::cos(angle));
    }
    build.tube(points, 0.07, 6, glm::normalize(dvec3(half.y, 0, -hand * half.x)));
  }
  build.lathe(Profile().lines({{0.17, 0.06}, {0.17, -0.02}}).arc({0, -0.02}, 0.17, 0, -0.5 * kPi, 5),
              center + height * kY, 20);
}

void addLowerBay(MeshBuilder& build, const Materials& m, double z) {
  const double wallHeight = kGallery - 0.25 - kSpringing;
  const dvec3 face(kArcadeFace, kSpringing, z), back(kArcadeBack, kSpringing, z);
  constexpr int kSegments = 32;
  build.use(m.stone, kStoneScale);
  build.archedWall(face, kZ, kY, 0.5 * kBay, wallHeight, kArchRadius, kSegments);
  build.archedWall(back, -kZ, kY, 0.5 * kBay, wallHeight, kArchRadius, kSegments);
  build.use(m.limestone, kPlainScale);
  build.sweepArc(soffit(kArchRadius, kArcadeBack - kArcadeFace), face, -kX, -kZ, kPi, kSegments);
  build.sweepArc(archivolt(kArchRadius, 0.27), face, -kX, -kZ, kPi, kSegments);
  build.sweepArc(fascia(kArchRadius, 0.27), back, kX, kZ, kPi, kSegments);
  build.roundedBox({kArcadeFace - 0.02, kSpringing + kArchRadius - 0.03, z}, {0.24, 0.40, 0.26}, 0.03, 1);

  const double middle = 0.5 * (kArcadeBack + kOuterWall);
  addGroinVault(build, m, {middle, kSpringing, z}, {0.5 * (kOuterWall - kArcadeBack), 0.5 * kBay}, 1.45);
  // The outer wall's field: a paneled dado.
  build.use(m.limestone, kPlainScale);
  build.box({kOuterWall - 0.07, 0, z - 1.5}, {kOuterWall + 0.1, 1.05, z + 1.5}, kAllFaces & ~kFaceRight & ~kFaceBottom);
  build.use(m.verde, kPlainScale);
  for (const double shift : {-0.98, 0.0, 0.98})
    build.roundedBox({kOuterWall - 0.07, 0.2, z + shift}, {0.05, 0.66, 0.8}, 0.015, 1);
}

void addTransverseArch(MeshBuilder& build, const Materials& m, double z) {
  build.use(m.limestone, kPlainScale);
  constexpr double kHalf = 0.26, kInner = 1.30, kOuter = 1.52, kDepth = 0.20;
  Profile band;
  band.lines({{kHalf, kOuter}, {kHalf, kInner + 0.06}, {kHalf - 0.05, kInner}, {0.05 - kHalf, kInner}});
  band.lines({{0.05 - kHalf, kInner}, {-kHalf, kInner + 0.06}, {-kHalf, kOuter}});
  build.sweepArc(band, {0.5 * (kArcadeBack + kOuterWall - kDepth), kSpringing, z}, kZ, -kX, kPi, 36);
  // The pilaster that carries it.
  build.box({kOuterWall - kDepth, 0, z - 0.3}, {kOuterWall + 0.1, kSpringing - 0.18, z + 0.3});
  build.box({kOuterWall - kDepth - 0.06, 0, z - 0.36}, {kOuterWall + 0.1, 0.35, z + 0.36});
  build.roundedBox({kOuterWall - 0.1, kSpringing - 0.30, z}, {0.30, 0.08, 0.70}, 0.03, 1);
  build.roundedBox({kOuterWall - 0.1, kSpringing - 0.2, z}, {0.36, 0.2, 0.78}, 0.03, 1);
}

void addUpperBay(MeshBuilder& build, const Materials& m, double z) {
  constexpr int kSegments = 24;
  const double height = kCeiling - kUpperSpringing;
  for (const double shift : {-0.25 * kBay, 0.25 * kBay}) {
    const dvec3 face(kUpperFace, kUpperSpringing, z + shift), back(kUpperBack, kUpperSpringing, z + shift);
    build.use(m.stone, kStoneScale);
    build.archedWall(face, kZ, kY, 0.25 * kBay, height, kUpperRadius, kSegments);
    build.archedWall(back, -kZ, kY, 0.25 * kBay, height, kUpperRadius, kSegments);
    build.use(m.limestone, kPlainScale);
    build.sweepArc(soffit(kUpperRadius, kUpperBack - kUpperFace), face, -kX, -kZ, kPi, kSegments);
    build.sweepArc(fascia(kUpperRadius, 0.15), face, -kX, -kZ, kPi, kSegments);
  }
  // Shutters on the gallery's wall.
  build.use(m.limestone, kPlainScale);
  build.box({kOuterWall - 0.05, kGallery, z - 0.72}, {kOuterWall + 0.05, kGallery + 2.45, z + 0.72});
  build.use(m.wood, 0.9);
  for (const double shift : {-0.31, 0.31})
    build.box({kOuterWall - 0.09, kGallery, z + shift - 0.29}, {kOuterWall, kGallery + 2.3, z + shift + 0.29},
              kAllFaces & ~kFaceRight);
  // Coffers: beams under the ceiling.
  for (int i = 0; i < 3; ++i) {
    const double at = z + kBay * (i - 1) / 3.0;
    build.box({kUpperBack, kCeiling - 0.2, at - 0.08}, {kOuterWall, kCeiling + 0.02, at + 0.08});
  }
}

// Half of the end wall's middle: an opening with a semicircular head.
void addOpening(MeshBuilder& build, const Materials& m, dvec3 springing, double halfWidth, double radius, double height,
                double thickness, bool upsideDown) {
  const double sign = upsideDown ? -1.0 : 1.0;
  build.use(m.stone, kStoneScale);
  build.archedWall(springing, sign * kX, sign * kY, halfWidth, height, radius, 48);
  build.archedWall(springing - thickness * kZ, -sign * kX, sign * kY, halfWidth, height, radius, 48);
  build.use(m.limestone, kPlainScale);
  build.sweepArc(soffit(radius, thickness), springing, kZ, -sign * kX, kPi, 48);
  build.sweepArc(archivolt(radius, 0.34), springing, kZ, -sign * kX, kPi, 48);
}

std::vector<dvec3> circle(dvec3 center, dvec3 right, dvec3 up, double radius, int segments) {
  std::vector<dvec3> points;
  for (int i = 0; i < segments; ++i) {
    const double angle = 2 * kPi * i / segments;
    points.push_back(center + radius * (std::cos(angle) * right + std::sin(angle) * up));
  }
  return points;
}

void addRoseWindow(MeshBuilder& build, const Materials& m, dvec3 center, double radius) {
  build.use(m.limestone, kPlainScale);
  const auto ring = [&](dvec3 middle, double size, double bar, int segments) {
    build.tube(circle(middle, kX, kY, size, segments), bar, 8, kZ, true);
  };
  ring(center, radius - 0.05, 0.07, 64);
  ring(center, 0.42 * radius, 0.05, 48);
  ring(center, 0.14 * radius, 0.04, 24);
  constexpr int kPetals = 12;
  for (int i = 0; i < kPetals; ++i) {
    const double angle = 2 * kPi * (i + 0.5) / kPetals;
    const dvec3 spoke(std::cos(angle), std::sin(angle), 0);
    const std::array<dvec3, 2> bar{center + 0.14 * radius * spoke, center + 0.66 * radius * spoke};
    build.tube(bar, 0.035, 8, kZ);
    const double half = angle + kPi / kPetals;
    ring(center + 0.80 * radius * dvec3(std::cos(half), std::sin(half), 0), 0.165 * radius, 0.03, 28);
  }
}

void addDoor(MeshBuilder& build, const Materials& m, dvec3 foot, double halfWidth, double height) {
  build.use(m.wood, 0.8);
  build.rectangle(foot + dvec3(-halfWidth, height, 0), 2 * halfWidth * kX, -height * kY);
  for (const double side : {-1.0, 1.0}) {
    const double middle = side * 0.5 * halfWidth;
    build.use(m.wood, 0.8);
    for (const double y : {0.0, 1.25, 2.5})
      build.roundedBox(foot + dvec3(middle, y + 0.15, 0.03), {0.76 * halfWidth, 1.0, 0.08}, 0.03, 2);
    build.use(m.iron);
    for (const double y : {0.04, 1.2, 2.45})
      for (int i = 0; i < 5; ++i)
        build.lathe(Profile().arc({0, 0}, 0.03, 0.5 * kPi, 0, 4),
                    foot + dvec3(middle + 0.3 * (i - 2) * halfWidth / 1.5, y + 0.03, 0), 10, kZ);
    build.use(m.bronze);
    build.tube(circle(foot + dvec3(side * 0.14, 1.32, 0.09), kX, kY, 0.09, 24), 0.014, 8, kZ, true);
  }
  build.use(m.iron);
  build.box(foot + dvec3(-0.03, 0, 0), foot + dvec3(0.03, height, 0.05), kAllFaces & ~kFaceBack);
}

}  // namespace

void addFloor(MeshBuilder& build, const Materials& m) {
  // Slabs of 0.9 m; each takes one of the texture's four slabs and a color.
  constexpr double kSlab = 0.9;
  const int across = static_cast<int>(std::lround(kOuterWall / kSlab * 2)),
            along = static_cast<int>(2 * kHalfLength / kSlab);
  const glm::vec4 cream(0.80f, 0.72f, 0.60f, 1), rosso(0.33f, 0.10f, 0.07f, 1), verde(0.06f, 0.12f, 0.10f, 1);
  for (int j = 0; j < along; ++j)
    for (int i = 0; i < across; ++i) {
      const int fromMiddle = std::abs(2 * i - across + 1) / 2;  // 0 in the middle of the nave
      const int fromEnd = std::min(j, along - 1 - j);
      const bool border = fromMiddle == 4 || fromEnd == 0;
      const bool even = (i + j) % 2 == 0;
      const glm::vec4 color = border ? rosso : (even ? cream : verde);
      const std::uint32_t bits = hash(static_cast<std::uint32_t>(j * across + i) + 7);
      build.use(m.floor, 1, color);
      const dvec2 cell(0.5 * (bits & 1u), 0.5 * (bits >> 1 & 1u));
      const int turn = static_cast<int>(bits >> 2 & 3u);
      const dvec3 corner(-kOuterWall + kSlab * i, 0, -kHalfLength + kSlab * j);
      build.grid(1, 1, [&](int column, int row) {
        SurfacePoint p;
        p.position = corner + dvec3(kSlab * column, 0, kSlab * row);
        dvec2 uv(column, row);
        for (int k = 0; k < turn; ++k) uv = dvec2(uv.y, 1 - uv.x);
        p.uv = cell + 0.5 * uv;
        return p;
      });
    }
  build.use(m.stone, kStoneScale);
  build.box({-kOuterWall - 0.4, -0.5, -kHalfLength - 0.6}, {kOuterWall + 0.4, 0, kHalfLength + 0.6},
            kAllFaces & ~kFaceTop);
}

void addShell(MeshBuilder& build, const Materials& m) {
  build.use(m.brick, kBrickScale);
  build.box({kOuterWall, 0, -kHalfLength}, {kOuterWall + 0.4, kGallery - 0.12, kHalfLength});
  build.use(m.ochre, kPlainScale);
  build.box({kOuterWall, kGallery - 0.12, -kHalfLength}, {kOuterWall + 0.4, kRoof, kHalfLength});
  build.use(m.stone, kStoneScale);
  build.box({kArcadeFace, kGallery - 0.25, -kHalfLength}, {kOuterWall, kGallery, kHalfLength});
  build.use(m.wood, 1.0);
  build.box({kUpperFace, kCeiling, -kHalfLength}, {kOuterWall + 0.4, kRoof, kHalfLength});
}

void addArcade(MeshBuilder& build, const Materials& m) {
  for (int k = 0; k < kBays; ++k) {
    addLowerBay(build, m, bayZ(k));
    addUpperBay(build, m, bayZ(k));
  }
  for (int k = 1; k < kBays; ++k) {
    addTransverseArch(build, m, columnZ(k));
    // A roundel in the spandrel above each column.
    const dvec3 center(kArcadeFace, 5.08, columnZ(k));
    build.use(m.limestone, kPlainScale);
    build.lathe(
        Profile().lines({{0.22, 0}, {0.22, 0.03}}).arc({0.25, 0.03}, 0.03, kPi, 0, 8).lines({{0.28, 0.03}, {0.28, 0}}),
        center, 40, -kX);
    build.use(m.verde, kPlainScale);
    build.disc(center - 0.012 * kX, -kX, 0.23, 40);
  }
  const double length = 2 * kHalfLength;
  addShell(build, m);
  for (const double x : {4.75, 5.75})
    build.box({x - 0.08, kCeiling - 0.2, -kHalfLength}, {x + 0.08, kCeiling + 0.02, kHalfLength});
  // Moldings toward the nave.
  build.use(m.limestone, kPlainScale);
  build.extrude(stringCourse(), {kArcadeFace, kGallery - 0.3, -kHalfLength}, -kX, kY, length);
  Profile cornice;
  cornice.lines({{0, 0.62}, {0.38, 0.62}, {0.38, 0.54}}).arc({0.28, 0.54}, 0.10, 0, -0.5 * kPi, 8);
  cornice.lines({{0.28, 0.44}, {0.20, 0.44}, {0.20, 0.38}, {0.08, 0.38}, {0.08, 0.20}});
  cornice.arc({0.08, 0.12}, 0.08, 0.5 * kPi, kPi, 6).lines({{0, 0.12}, {0, 0}});
  build.extrude(cornice, {kUpperFace - 0.005, kCeiling - 0.05, -kHalfLength}, -kX, kY, length);
  const int dentils = 144;
  for (int i = 0; i < dentils; ++i) {
    const double z = -kHalfLength + length * (i + 0.5) / dentils;
    build.box({kUpperFace - 0.17, kCeiling + 0.19, z - 0.06}, {kUpperFace - 0.08, kCeiling + 0.33, z + 0.06},
              kAllFaces & ~kFaceRight & ~kFaceTop);
  }
}

void addEndWall(MeshBuilder& build, const Materials& m) {
  constexpr double kThick = 0.6, kDoor = 1.5, kDoorSpringing = 2.7, kRose = 1.6, kRoseCenter = 7.95;
  const double front = -kHalfLength, back = front - kThick;
  const double middle = 5.75;  // between the door's field and the window's
  const double half = kArcadeFace;
  // The parts beside the nave, and beside the door.
  build.use(m.stone, kStoneScale);
  for (const double side : {-1.0, 1.0}) {
    const double inner = side * half, outer = side * (kOuterWall + 0.4);
    build.box({std::min(inner, outer), 0, back}, {std::max(inner, outer), kRoof, front});
    const double jamb = side * kDoor;
    build.box({std::min(inner, jamb), 0, back}, {std::max(inner, jamb), kDoorSpringing, front}, kAllFaces & ~kFaceTop);
  }
  addOpening(build, m, {0, kDoorSpringing, front}, half, kDoor, middle - kDoorSpringing, kThick, false);
  addOpening(build, m, {0, kRoseCenter, front}, half, kRose, kRoof - kRoseCenter, kThick, false);
  addOpening(build, m, {0, kRoseCenter, front}, half, kRose, kRoseCenter - middle, kThick, true);
  addRoseWindow(build, m, {0, kRoseCenter, front - 0.5 * kThick}, kRose);
  addDoor(build, m, {0, 0.0, front - 0.35}, kDoor + 0.02, kDoorSpringing + kDoor + 0.05);

  build.use(m.limestone, kPlainScale);
  for (const double side : {-1.0, 1.0}) {
    build.roundedBox({side * (kDoor + 0.17), 0, front}, {0.34, kDoorSpringing - 0.12, 0.14}, 0.02, 2);
    build.roundedBox({side * (kDoor + 0.17), kDoorSpringing - 0.16, front}, {0.46, 0.16, 0.26}, 0.03, 2);
    build.roundedBox({side * (kDoor + 0.17), 0, front}, {0.46, 0.3, 0.26}, 0.03, 2);
    // Piers that end the arcades, below and above.
    build.box({std::min(side * 3.15, side * 4.05), 0, front},
              {std::max(side * 3.15, side * 4.05), kSpringing - 0.16, front + 0.3});
    build.roundedBox({side * 3.6, kSpringing - 0.16, front + 0.14}, {1.02, 0.17, 0.44}, 0.03, 2);
    build.roundedBox({side * 3.6, 0, front + 0.14}, {1.02, 0.35, 0.44}, 0.03, 2);
    build.box({std::min(side * 3.38, side * 3.82), kGallery, front},
              {std::max(side * 3.38, side * 3.82), kUpperSpringing, front + 0.18});
  }
  build.extrude(stringCourse(), {-half, middle - 0.3, front}, kZ, kY, 2 * half);
  Profile cornice;
  cornice.lines({{0, 0.56}, {0.30, 0.56}, {0.30, 0.48}}).arc({0.2, 0.48}, 0.10, 0, -0.5 * kPi, 8);
  cornice.lines({{0.2, 0.38}, {0.08, 0.38}, {0.08, 0.15}, {0, 0.15}});
  build.extrude(cornice, {-half - 0.2, kRoof - 0.52, front}, kZ, kY, 2 * half + 0.4);
}

void addRoofRibs(MeshBuilder& build, const Materials& m) {
  build.use(m.iron);
  constexpr int kSegments = 40;
  constexpr double kInner = kRibRadius - 0.42;
  const auto on = [](double radius, double angle, double z) {
    return dvec3(-radius * std::cos(angle), kRoof + radius * std::sin(angle), z);
  };
  std::vector<dvec3> points(kSegments + 1);
  for (int k = 0; k <= kBays; ++k) {
    const double z = columnZ(k);
    for (const double radius : {kRibRadius, kInner}) {
      for (int i = 0; i <= kSegments; ++i) points[static_cast<std::size_t>(i)] = on(radius, kPi * i / kSegments, z);
      build.tube(points, radius == kInner ? 0.035 : 0.05, 6, kZ);
    }
    for (int i = 0; i < kSegments; ++i) {
      const bool even = i % 2 == 0;
      const std::array<dvec3, 2> bar{on(even ? kRibRadius : kInner, kPi * i / kSegments, z),
                                     on(even ? kInner : kRibRadius, kPi * (i + 1) / kSegments, z)};
      build.tube(bar, 0.018, 4, kZ);
    }
  }
  for (int i = 1; i < 10; ++i) {
    const dvec3 from = on(kRibRadius, kPi * i / 10, -kHalfLength);
    const std::array<dvec3, 2> purlin{from, from + 2 * kHalfLength * kZ};
    build.tube(purlin, i == 5 ? 0.06 : 0.03, 8, kX + kY);
  }
}

}  // namespace halfsilver::atrium
