#include <array>
#include <cmath>
#include <vector>

#include "builtin/atrium_parts.h"

// Columns and railings of the atrium.
namespace halfsilver::atrium {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr double kShaftFoot = 0.55, kShaftTop = 2.93;

double shaftRadius(double t) { return 0.32 - 0.05 * (0.35 * t + 0.65 * t * t); }  // t 0 at the foot

// Twenty flutes with rounded ends between narrow fillets.
void addFlutedShaft(MeshBuilder& build, double foot, double top) {
  constexpr int kFlutes = 20, kAcross = 4, kRows = 6;
  constexpr double kTurn = 2 * kPi / kFlutes, kFillet = 0.2 * kTurn, kDepth = 0.09;
  // Rows gather at the flutes' ends.
  const auto fromTop = [](double t) { return t - 0.8 * std::sin(2 * kPi * t) / (2 * kPi); };
  const auto point = [&](double angle, double t, double hollow) {
    const double down = fromTop(t);
    const double end = std::min(1.0, std::min(down, 1 - down) / 0.03);
    const double depth = kDepth * hollow * std::sqrt(std::max(0.0, end * (2 - end)));
    const double radius = shaftRadius(1 - down) * (1 - depth);
    return dvec3(radius * std::sin(angle), top - (top - foot) * down, radius * std::cos(angle));
  };
  for (int flute = 0; flute < kFlutes; ++flute) {
    const double begin = kTurn * flute;
    const dvec2 repeats(kTurn * 0.3 / kPlainScale, (top - foot) / kPlainScale);
    build.surface(1, kRows, repeats * dvec2(0.2, 1),
                  [&](double s, double t) { return point(begin + kFillet * s, t, 0); });
    build.surface(kAcross, kRows, repeats * dvec2(0.8, 1), [&](double s, double t) {
      return point(begin + kFillet + (kTurn - kFillet) * s, t, std::sin(kPi * s));
    });
  }
}

// A leaf that rises along the capital's bell and curls over at its tip.
void addCarvedLeaf(MeshBuilder& build, double angle, double foot, double height, double reach, double width) {
  const dvec3 out(std::sin(angle), 0, std::cos(angle)), across(std::cos(angle), 0, -std::sin(angle));
  build.surface(4, 8, {0.1, 0.2}, [&](double s, double t) {
    const double up = 1 - t, side = 2 * s - 1;
    const double curl = std::max(0.0, up - 0.6) / 0.4;
    const double radius = 0.285 + 0.05 * up + reach * curl * curl - 0.05 * side * side * (1 - 0.3 * curl);
    const double y = foot + height * (up - 0.42 * curl * curl);
    const double half = 0.5 * width * (1.0 - 0.65 * std::pow(up, 3.0)) * (1 + 0.12 * std::cos(5 * kPi * up));
    return radius * out + half * side * across + dvec3(0, y + 0.012 * std::cos(4 * kPi * side) * (1 - curl), 0);
  });
}

Mesh lowerColumn(const Materials& m) {
  MeshBuilder build;
  build.use(m.limestone, kPlainScale);
  build.roundedBox({0, 0, 0}, {0.94, 0.22, 0.94}, 0.02, 1);
  Profile base;
  base.lines({{0.325, kShaftFoot}, {0.36, kShaftFoot}, {0.36, 0.51}, {0.345, 0.51}});
  base.arc({0.345, 0.475}, 0.035, 0.5 * kPi, -0.5 * kPi, 5).lines({{0.345, 0.44}, {0.385, 0.44}, {0.385, 0.425}});
  base.arc({0.385, 0.38}, 0.045, 0.5 * kPi, 1.5 * kPi, 5).lines({{0.385, 0.335}, {0.40, 0.335}});
  base.arc({0.40, 0.2775}, 0.0575, 0.5 * kPi, -0.5 * kPi, 6);
  build.lathe(base, dvec3(0), 40);
  addFlutedShaft(build, kShaftFoot, kShaftTop);
  // Astragal, bell and lip.
  Profile capital;
  std::vector<dvec2> bell;
  for (int i = 0; i <= 7; ++i) {
    const double t = 1 - i / 7.0;
    bell.emplace_back(0.275 + 0.11 * t * t * t, 3.0 + 0.40 * t);
  }
  capital.lines({{0.30, 3.46}, {0.42, 3.46}}).arc({0.42, 3.44}, 0.02, 0.5 * kPi, -0.5 * kPi, 3);
  capital.lines({{0.42, 3.42}, {0.385, 3.40}}).curve(bell);
  capital.lines({{0.275, 3.0}, {0.285, 3.0}}).arc({0.285, 2.965}, 0.035, 0.5 * kPi, -0.5 * kPi, 5);
  capital.lines({{0.285, kShaftTop}, {0.265, kShaftTop}});
  build.lathe(capital, dvec3(0), 40);
  build.roundedBox({0, 3.45, 0}, {0.86, 0.05, 0.86}, 0.02, 1);
  build.roundedBox({0, 3.49, 0}, {0.92, 0.11, 0.92}, 0.03, 2);
  build.use(m.carved, kPlainScale);
  for (int i = 0; i < 8; ++i) {
    addCarvedLeaf(build, kPi * (i + 0.5) / 4, 3.0, 0.24, 0.09, 0.20);
    addCarvedLeaf(build, kPi * i / 4, 3.0, 0.43, i % 2 == 0 ? 0.11 : 0.19, 0.19);
  }
  return build.take();
}

// Its foot at y = 0; 2.45 high.
Mesh upperColumn(const Materials& m) {
  MeshBuilder build;
  build.use(m.limestone, kPlainScale);
  build.roundedBox({0, 0, 0}, {0.36, 0.14, 0.36}, 0.015, 1);
  Profile p;
  p.lines({{0.16, 2.31}, {0.20, 2.31}}).arc({0.16, 2.27}, 0.04, 0, -0.5 * kPi, 4);
  std::vector<dvec2> bell, shaft;
  for (int i = 0; i <= 4; ++i) {
    const double t = 1 - i / 4.0;
    bell.emplace_back(0.115 + 0.045 * t * t, 2.08 + 0.15 * t);
  }
  for (int i = 0; i <= 4; ++i) {
    const double t = 1 - i / 4.0;
    shaft.emplace_back(0.135 - 0.022 * t * t, 0.30 + 1.73 * t);
  }
  p.curve(bell).lines({{0.115, 2.08}, {0.12, 2.08}}).arc({0.12, 2.06}, 0.02, 0.5 * kPi, -0.5 * kPi, 4);
  p.lines({{0.12, 2.04}, {0.113, 2.03}}).curve(shaft);
  p.lines({{0.135, 0.30}, {0.145, 0.30}}).arc({0.145, 0.275}, 0.025, 0.5 * kPi, -0.5 * kPi, 4);
  p.lines({{0.145, 0.25}, {0.155, 0.25}, {0.155, 0.235}});
  p.arc({0.155, 0.215}, 0.02, 0.5 * kPi, 1.5 * kPi, 4).lines({{0.155, 0.195}, {0.155, 0.19}});
  p.arc({0.155, 0.165}, 0.025, 0.5 * kPi, -0.5 * kPi, 4);
  build.lathe(p, dvec3(0), 24);
  build.roundedBox({0, 2.30, 0}, {0.42, 0.15, 0.42}, 0.025, 1);
  return build.take();
}

}  // namespace

void addColumns(MeshBuilder& build, const Materials& m) {
  const Mesh lower = lowerColumn(m), upper = upperColumn(m);
  for (int k = 1; k < kBays; ++k) build.append(lower, {{kColumnAxis, 0, columnZ(k)}, 0});
  for (int k = 1; k < 2 * kBays; ++k) build.append(upper, {{kColumnAxis, kGallery, -kHalfLength + 0.5 * kBay * k}, 0});
}

void addRailing(MeshBuilder& build, const Materials& m) {
  constexpr double kRailX = 3.22, kTop = kGallery + 1.0, kSpacing = 0.12;
  constexpr dvec3 kOut(-1, 0, 0), kUp(0, 1, 0);
  const double length = 2 * kHalfLength;
  // A turned bar with a bead in its middle.
  MeshBuilder bar;
  bar.use(m.railing);
  Profile p;
  p.lines({{0.011, 0.94}, {0.011, 0.54}}).arc({0.011, 0.515}, 0.02, 0.5 * kPi, -0.5 * kPi, 3);
  p.lines({{0.011, 0.49}, {0.011, 0.10}});
  bar.lathe(p, dvec3(0), 6);
  const int bars = static_cast<int>(std::lround(length / kSpacing));
  for (int i = 0; i < bars; ++i)
    if (i % 15 != 7) build.append(bar.mesh(), {{kRailX, kGallery, -kHalfLength + kSpacing * (i + 0.5)}, 0});
  build.use(m.railing);
  build.box({kRailX - 0.02, kGallery + 0.08, -kHalfLength}, {kRailX + 0.02, kGallery + 0.11, kHalfLength});
  build.box({kRailX - 0.02, kGallery + 0.90, -kHalfLength}, {kRailX + 0.02, kGallery + 0.94, kHalfLength});
  for (int i = 7; i < bars; i += 15) {
    const double z = -kHalfLength + kSpacing * (i + 0.5);
    build.box({kRailX - 0.03, kGallery, z - 0.03}, {kRailX + 0.03, kTop + 0.02, z + 0.03});
    build.lathe(Profile().arc({0, 0}, 0.055, 0.5 * kPi, -0.5 * kPi, 8), {kRailX, kTop + 0.07, z}, 16);
  }
  // The closed outline of the handrail.
  Profile rail;
  rail.arc({0, kTop - 0.01}, 0.045, kPi, 0, 8)
      .lines({{0.045, kTop - 0.01}, {0.035, kTop - 0.06}, {-0.035, kTop - 0.06}});
  rail.lines({{-0.035, kTop - 0.06}, {-0.045, kTop - 0.01}});
  build.use(m.wood, 1.0);
  build.extrude(rail, {kRailX, 0, -kHalfLength}, kOut, kUp, length);
}

}  // namespace halfsilver::atrium
