#pragma once

#include "builtin/parts.h"

// The atrium's measures (meters) and materials; private to the builtin_atrium files. The hall lies along z, its floor
// at y = 0: a nave open to the sky between two arcades, each with a vaulted aisle and a gallery above it.
namespace halfsilver::atrium {

inline constexpr int kBays = 8;
inline constexpr double kBay = 3.6;
inline constexpr double kHalfLength = 0.5 * kBays * kBay;
inline constexpr double kColumnAxis = 3.6;   // |x|
inline constexpr double kArcadeFace = 3.25;  // |x|, toward the nave
inline constexpr double kArcadeBack = 3.95;
inline constexpr double kOuterWall = 6.75;
inline constexpr double kSpringing = 3.6;  // y of the lower arches
inline constexpr double kArchRadius = 1.45;
inline constexpr double kGallery = 5.75;    // y of the gallery's floor
inline constexpr double kUpperFace = 3.42;  // |x| of the upper arcade
inline constexpr double kUpperBack = 3.78;
inline constexpr double kUpperSpringing = 8.2;
inline constexpr double kUpperRadius = 0.72;
inline constexpr double kCeiling = 9.6;
inline constexpr double kRoof = 10.15;
inline constexpr double kRibRadius = 3.6;  // of the iron ribs above the nave
inline constexpr double kLanternFoot = 4.9;
// Meters per repetition of a texture.
inline constexpr double kStoneScale = 2.4, kPlainScale = 2.0;

struct Materials {
  std::uint32_t floor, stone, brick, ochre, limestone, carved, vault, verde, wood, railing, iron, bronze, terracotta,
      soil, leaves, drapeRed, drapeTeal, drapeGold, glass;
};

Materials makeMaterials(Scene& scene);

// The underside of an arch.
inline Profile soffit(double radius, double depth) { return Profile().lines({{0, radius}, {-depth, radius}}); }

// z of column k, 0..kBays; of the middle of bay k, 0..kBays-1.
inline double columnZ(int k) { return -kHalfLength + kBay * k; }
inline double bayZ(int k) { return columnZ(k) + 0.5 * kBay; }

void addFloor(MeshBuilder& build, const Materials& materials);
// Of one side, at x > 0: outer wall, gallery floor and roof, as closed boxes, so that no light leaks in.
void addShell(MeshBuilder& build, const Materials& materials);
// One side with its shell, without its columns and furniture.
void addArcade(MeshBuilder& build, const Materials& materials);
void addColumns(MeshBuilder& build, const Materials& materials);  // of one side
// The end at z < 0.
void addEndWall(MeshBuilder& build, const Materials& materials);
void addRoofRibs(MeshBuilder& build, const Materials& materials);
void addRailing(MeshBuilder& build, const Materials& materials);  // of one side
void addDrapes(MeshBuilder& build, const Materials& materials);
void addPottedPlant(MeshBuilder& build, const Materials& materials, glm::dvec3 base, std::uint32_t seed);
void addPlants(MeshBuilder& build, const Materials& materials);
void addCentrepiece(MeshBuilder& build, const Materials& materials);
void addLantern(MeshBuilder& build, const Materials& materials, double z);
void addLanterns(MeshBuilder& build, const Materials& materials);
// Positions of the lanterns.
inline constexpr double kLanternZ[] = {-10.8, -3.6, 3.6, 10.8};

}  // namespace halfsilver::atrium
