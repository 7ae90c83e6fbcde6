#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

// The C++ side of shaders/shared/structs.h and rays.h: the same names and layouts. std140 and std430 align a vec3 to 16
// bytes and a vec2 to 8, and round a struct with a vec3 up to 16; C++ does not, so every offset and size is asserted,
// those of the scene in frame/scene_layout.cpp.
namespace halfsilver::shared {

using glm::mat4;
using glm::vec2;
using glm::vec3;
using glm::vec4;
using uint = std::uint32_t;

#include "shared/bindings.h"
#include "shared/rays.h"
#include "shared/structs.h"

#define HALFSILVER_AT(type, member, offset) static_assert(offsetof(type, member) == (offset), #type "::" #member)

HALFSILVER_AT(Ray, origin, 0);
HALFSILVER_AT(Ray, maxDistance, 12);
HALFSILVER_AT(Ray, direction, 16);
HALFSILVER_AT(Ray, excluded, 28);
static_assert(sizeof(Ray) == 32);

HALFSILVER_AT(RayPath, throughput, 0);
HALFSILVER_AT(RayPath, pathLength, 12);
HALFSILVER_AT(RayPath, pixel, 16);
HALFSILVER_AT(RayPath, kindAndCounts, 20);
HALFSILVER_AT(RayPath, slot, 24);
HALFSILVER_AT(RayPath, media, 28);
static_assert(sizeof(RayPath) == 32);

HALFSILVER_AT(Radiance, sum, 0);
HALFSILVER_AT(Radiance, pixel, 12);
static_assert(sizeof(Radiance) == 16);

HALFSILVER_AT(RayCount, groupsX, 0);
HALFSILVER_AT(RayCount, groupsY, 4);
HALFSILVER_AT(RayCount, groupsZ, 8);
HALFSILVER_AT(RayCount, count, 12);
HALFSILVER_AT(RayCount, reflecting, 16);
HALFSILVER_AT(RayCount, unfinished, 20);
HALFSILVER_AT(RayCount, overflow, 24);
HALFSILVER_AT(RayCount, source, 28);
HALFSILVER_AT(RayCount, byKind, 32);
static_assert(sizeof(RayCount) == 32 + 4 * RAY_KINDS);

static_assert(sizeof(ScatteredPath) == sizeof(RayPath));
HALFSILVER_AT(ScatteredPath, pathLength, offsetof(RayPath, pathLength));
HALFSILVER_AT(ScatteredPath, pixel, offsetof(RayPath, pixel));
HALFSILVER_AT(ScatteredPath, kindAndSample, offsetof(RayPath, kindAndCounts));
HALFSILVER_AT(ScatteredPath, media, 24);
HALFSILVER_AT(ScatteredPath, density, 28);

HALFSILVER_AT(LightSum, high, 12);
static_assert(sizeof(LightSum) == 24);

HALFSILVER_AT(RayWork, steps, 0);
HALFSILVER_AT(RayWork, tests, 4);
static_assert(sizeof(RayWork) == 8);

HALFSILVER_AT(Hit, t, 0);
HALFSILVER_AT(Hit, triangle, 4);
HALFSILVER_AT(Hit, u, 8);
HALFSILVER_AT(Hit, v, 12);
static_assert(sizeof(Hit) == 16);

HALFSILVER_AT(KindTally, high, 12);
static_assert(sizeof(KindTally) == 16);

HALFSILVER_AT(PausedRay, t, 0);
HALFSILVER_AT(PausedRay, bestTriangle, 4);
HALFSILVER_AT(PausedRay, tested, 8);
HALFSILVER_AT(PausedRay, own, 12);
static_assert(sizeof(PausedRay) == 16);

HALFSILVER_AT(HitSurface, baseColor, 0);
HALFSILVER_AT(HitSurface, normal, 16);
HALFSILVER_AT(HitSurface, reflectivity, 28);
static_assert(sizeof(HitSurface) == 32);

HALFSILVER_AT(FrameConstants, viewProjection, 0);
HALFSILVER_AT(FrameConstants, eye, 64);
HALFSILVER_AT(FrameConstants, pixelCone, 76);
HALFSILVER_AT(FrameConstants, forward, 80);
HALFSILVER_AT(FrameConstants, nearPlane, 92);
HALFSILVER_AT(FrameConstants, right, 96);
HALFSILVER_AT(FrameConstants, farPlane, 108);
HALFSILVER_AT(FrameConstants, up, 112);
HALFSILVER_AT(FrameConstants, minDistance, 124);
HALFSILVER_AT(FrameConstants, boundsLow, 128);
HALFSILVER_AT(FrameConstants, diagonal, 140);
HALFSILVER_AT(FrameConstants, boundsHigh, 144);
HALFSILVER_AT(FrameConstants, skyIsImage, 156);
HALFSILVER_AT(FrameConstants, skyZenith, 160);
HALFSILVER_AT(FrameConstants, skyIntensity, 172);
HALFSILVER_AT(FrameConstants, skyHorizon, 176);
HALFSILVER_AT(FrameConstants, toneMap, 188);
HALFSILVER_AT(FrameConstants, skyGround, 192);
HALFSILVER_AT(FrameConstants, exposure, 204);
HALFSILVER_AT(FrameConstants, width, 208);
HALFSILVER_AT(FrameConstants, height, 212);
HALFSILVER_AT(FrameConstants, directLights, 216);
HALFSILVER_AT(FrameConstants, cullBackFaces, 220);
HALFSILVER_AT(FrameConstants, maxRoughness, 224);
HALFSILVER_AT(FrameConstants, minReflectivity, 228);
HALFSILVER_AT(FrameConstants, selectFraction, 232);
HALFSILVER_AT(FrameConstants, minContribution, 236);
HALFSILVER_AT(FrameConstants, selectMode, 240);
HALFSILVER_AT(FrameConstants, selectPattern, 244);
HALFSILVER_AT(FrameConstants, fill, 248);
HALFSILVER_AT(FrameConstants, traces, 252);
HALFSILVER_AT(FrameConstants, skyDirections, 256);
HALFSILVER_AT(FrameConstants, hemispheres, 260);
HALFSILVER_AT(FrameConstants, jitter, 264);
HALFSILVER_AT(FrameConstants, effect, 272);
HALFSILVER_AT(FrameConstants, allLight, 276);
HALFSILVER_AT(FrameConstants, effectSamples, 280);
HALFSILVER_AT(FrameConstants, firstPass, 284);
HALFSILVER_AT(FrameConstants, occlusionRadius, 288);
HALFSILVER_AT(FrameConstants, glossySamples, 292);
HALFSILVER_AT(FrameConstants, blends, 296);
HALFSILVER_AT(FrameConstants, roulette, 300);
HALFSILVER_AT(FrameConstants, layerOpacity, 304);
HALFSILVER_AT(FrameConstants, transfer, 308);
HALFSILVER_AT(FrameConstants, bounces, 312);
HALFSILVER_AT(FrameConstants, mappedLights, 316);
HALFSILVER_AT(FrameConstants, shadowSamples, 320);
HALFSILVER_AT(FrameConstants, drawnNear, 324);
HALFSILVER_AT(FrameConstants, parallel, 328);
HALFSILVER_AT(FrameConstants, rayRules, 332);
HALFSILVER_AT(FrameConstants, coats, 336);
HALFSILVER_AT(FrameConstants, transmission, 340);
static_assert(sizeof(FrameConstants) == 352);

#undef HALFSILVER_AT

}  // namespace halfsilver::shared
