#include "passes/light_list.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "passes/sky_light.h"
#include "scene/tangents.h"

namespace halfsilver {
namespace {

using glm::mat4;
using glm::vec3;
using glm::vec4;

// The sky's light is smooth: a sixteenth of a layer per direction, but at least this many texels along a side.
constexpr int kSkyTiles = 4;
constexpr int kMinTile = 64;
// Texels around a fitted view that the filter may reach.
constexpr int kMargin = 4;
// Light that reaches a surface by way of others, for a mean reflectance of 0.35: once, twice and so on sum up to
// 0.35 / (1 - 0.35) of the direct light.
constexpr float kBounced = 0.54f;
// Share of the bounced light that also reaches places which see no sky.
constexpr float kSteadyBounce = 0.5f;

std::array<vec3, 8> corners(const Bounds& bounds) {
  std::array<vec3, 8> all;
  for (unsigned i = 0; i < 8; ++i)
    all[i] = {i & 1 ? bounds.high.x : bounds.low.x, i & 2 ? bounds.high.y : bounds.low.y,
              i & 4 ? bounds.high.z : bounds.low.z};
  return all;
}

// Bounds that can be looked at: not empty, not flat.
Bounds solid(Bounds bounds) {
  if (bounds.empty()) bounds.add(vec3(0));
  // More than rounding of the coordinates, so that something is left.
  const vec3 farthest = glm::max(glm::abs(bounds.low), glm::abs(bounds.high));
  const float least =
      std::max({1e-4f * bounds.diagonal(), 1e-6f * std::max({farthest.x, farthest.y, farthest.z}), 1e-30f});
  bounds.low -= vec3(least);
  bounds.high += vec3(least);
  return bounds;
}

// Clip space to a rectangle of a layer (0..1) and depth 0..1.
mat4 clipToMap(const glm::ivec4& rectangle, int resolution) {
  const glm::vec2 scale = glm::vec2(rectangle.z, rectangle.w) / static_cast<float>(resolution);
  const glm::vec2 offset = glm::vec2(rectangle.x, rectangle.y) / static_cast<float>(resolution);
  return glm::translate(mat4(1), vec3(offset + 0.5f * scale, 0.5f)) * glm::scale(mat4(1), vec3(0.5f * scale, 0.5f));
}

// The part of a view that looks along z at the bounds, by the place of points in it: what lies in the rectangle, with
// all that may cast shadows there.
Bounds column(const std::array<vec3, 8>& points, Bounds rectangle) {
  constexpr float kFarther = 1e30f;
  Bounds found;
  rectangle.low.z = -kFarther;
  rectangle.high.z = kFarther;
  const vec3 edges[3] = {points[1] - points[0], points[2] - points[0], points[4] - points[0]};
  // Edges of the bounds, clipped to the rectangle.
  for (unsigned i = 0; i < 8; ++i)
    for (unsigned axis = 0; axis < 3; ++axis)
      if (const unsigned other = i | 1u << axis; other != i) {
        const vec3 way = points[other] - points[i];
        glm::vec2 part(0, 1);
        for (int side = 0; side < 2; ++side) {
          const float from = points[i][side], by = way[side];
          const glm::vec2 ends(rectangle.low[side] - from, rectangle.high[side] - from);
          if (by == 0 && (ends.x > 0 || ends.y < 0)) part.y = -1;
          if (by == 0) continue;
          part = {std::max(part.x, std::min(ends.x / by, ends.y / by)),
                  std::min(part.y, std::max(ends.x / by, ends.y / by))};
        }
        if (part.x > part.y) continue;
        found.add(points[i] + part.x * way);
        found.add(points[i] + part.y * way);
      }
  // Lines through the rectangle's corners, clipped to the bounds.
  for (unsigned corner = 0; corner < 4; ++corner) {
    const vec3 from(corner & 1 ? rectangle.high.x : rectangle.low.x, corner & 2 ? rectangle.high.y : rectangle.low.y,
                    0);
    glm::vec2 part(-kFarther, kFarther);
    for (const vec3& edge : edges) {
      const float along = edge.z, start = glm::dot(from - points[0], edge), length = glm::dot(edge, edge);
      if (along == 0 && (start < 0 || start > length)) part.y = -2 * kFarther;
      if (along == 0) continue;
      const float a = -start / along, b = (length - start) / along;
      part = {std::max(part.x, std::min(a, b)), std::min(part.y, std::max(a, b))};
    }
    if (part.x > part.y) continue;
    found.add({from.x, from.y, part.x});
    found.add({from.x, from.y, part.y});
  }
  return found;
}

struct Fit {
  mat4 worldToClip{1};
  float texel = 0;  // meters
};

// The smallest orthographic view of the core along a direction, among those that lie along one of the axes, with all of
// the bounds that lies before and behind it.
Fit fitOrthographic(const Bounds& bounds, const Bounds& core, const vec3& direction, int size) {
  const std::array<vec3, 8> points = corners(core);
  Fit best;
  float bestArea = std::numeric_limits<float>::max();
  for (int axis = 0; axis < 3; ++axis) {
    vec3 along(0);
    along[axis] = 1;
    const vec3 across = glm::cross(direction, along);
    if (glm::length(across) < 1e-3f) continue;
    const vec3 right = glm::normalize(across);
    const vec3 up = glm::cross(right, direction);
    Bounds view;
    const auto seen = [&](const vec3& p) { return vec3(glm::dot(p, right), glm::dot(p, up), glm::dot(p, direction)); };
    for (const vec3& p : points) view.add(seen(p));
    if (view.extent().x * view.extent().y >= bestArea) continue;
    bestArea = view.extent().x * view.extent().y;
    if (core != bounds) {
      std::array<vec3, 8> all = corners(bounds);
      for (vec3& p : all) p = seen(p);
      const Bounds whole = column(all, view);
      view.low.z = std::min(view.low.z, whole.low.z);
      view.high.z = std::max(view.high.z, whole.high.z);
    }
    const vec3 extent = view.extent();
    const float inner = static_cast<float>(size) / static_cast<float>(size - 2 * std::min(kMargin, size / 4));
    const vec3 half = 0.5f * extent * vec3(inner, inner, 1.002f);
    const vec3 center = view.center();
    mat4 m(1);
    const vec3 rows[3] = {right / half.x, up / half.y, direction / half.z};
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) m[c][r] = rows[r][c];
      m[3][r] = -center[r] / half[r];
    }
    best.worldToClip = m;
    best.texel = 2 * std::max(half.x, half.y) / static_cast<float>(size);
  }
  return best;
}

// A perspective view from a light; `spread` is the tangent of half its angle.
Fit fitPerspective(const Bounds& bounds, const Bounds& core, const Light& light, const vec3& direction, const vec3& up,
                   float spread, int size) {
  const auto reach = [&light](const Bounds& box) {
    float far = 0;
    for (const vec3& p : corners(box)) far = std::max(far, glm::distance(p, light.position));
    return light.range > 0 ? std::min(far, light.range) : far;
  };
  const float far = reach(bounds), near = 2e-4f * std::min(reach(core), far);
  Fit fit;
  fit.worldToClip = glm::frustum(-spread * near, spread * near, -spread * near, spread * near, near, far) *
                    glm::lookAt(light.position, light.position + direction, up);
  fit.texel = 2 * spread / static_cast<float>(size);
  return fit;
}

constexpr float kWidestMap = glm::radians(80.0f);  // half angle of a spot that one map can show

// `nested`: how many maps a directional light has.
int layersOf(const Light& light, std::size_t nested) {
  if (light.type == LightType::directional) return static_cast<int>(nested);
  return light.type == LightType::spot && light.outerConeAngle <= kWidestMap ? 1 : 6;
}

// Shares the layers out: how many lights, from the first, have shadows, and how many tiles the sky has.
struct Shares {
  int lightLayers = 0;
  std::size_t shadowed = 0;
  int tile = 0;  // texels along a side
  int tilesPerLayer = 1;
  int directions = 0;
};

// What the maps of a directional light show, each a part of the next, the last one all.
struct Nested {
  const VisibleBody* seen = nullptr;  // the first's, in perspective
  std::vector<Bounds> boxes;

  std::size_t layers() const { return boxes.size() + (seen ? 1 : 0); }
};

// A light without shadows is worse than one whose maps are coarse: maps go until the layers suffice for all lights,
// those around the eye first (the largest), then what the camera sees, then the core. The whole stays.
void keepRoomForLights(std::span<const Light> lights, const LightListLimits& limits, std::size_t around, Nested& nested,
                       std::vector<std::string>& warnings) {
  const auto wanted = [&] {
    int layers = 0;
    for (const Light& light : lights) layers += layersOf(light, nested.layers());
    return layers;
  };
  const std::size_t all = nested.layers();
  while (limits.mapsOfLights && nested.layers() > 1 && wanted() > limits.layers) {
    if (around == 0 && nested.seen) {
      nested.seen = nullptr;
      continue;
    }
    const std::size_t last = around > 0 ? --around : 0;
    nested.boxes.erase(nested.boxes.begin() + static_cast<std::ptrdiff_t>(last));
  }
  if (nested.layers() < all)
    warnings.push_back("shadow maps: room for " + std::to_string(nested.layers()) + " of " + std::to_string(all) +
                       " maps of a directional light");
}

Shares share(std::span<const Light> lights, const LightListLimits& limits, std::size_t nested,
             std::vector<std::string>& warnings) {
  Shares shares;
  shares.tile = std::max(limits.resolution / kSkyTiles, std::min(limits.resolution, kMinTile));
  const int perSide = limits.resolution / shares.tile;
  shares.tilesPerLayer = perSide * perSide;
  const std::span<const Light> mapped = limits.mapsOfLights ? lights : std::span<const Light>();
  for (const Light& light : mapped) {
    if (shares.lightLayers + layersOf(light, nested) > limits.layers) break;
    shares.lightLayers += layersOf(light, nested);
    ++shares.shadowed;
  }
  const long long room = static_cast<long long>(limits.layers - shares.lightLayers) * shares.tilesPerLayer;
  shares.directions = static_cast<int>(std::min<long long>(limits.skyDirections, room));
  if (shares.directions < limits.skyDirections)
    warnings.push_back("shadow maps: room for " + std::to_string(shares.directions) + " of " +
                       std::to_string(limits.skyDirections) + " directions of the sky");
  if (shares.shadowed < mapped.size())
    warnings.push_back("shadow maps: no room for the shadows of " + std::to_string(mapped.size() - shares.shadowed) +
                       " of " + std::to_string(mapped.size()) + " lights");
  return shares;
}

void addView(LightList& list, shared::GpuLight& light, int matrix, const Fit& fit, int layer,
             const glm::ivec4& rectangle, int resolution) {
  list.views.push_back({layer, rectangle, fit.worldToClip});
  light.shadow[matrix] = clipToMap(rectangle, resolution) * fit.worldToClip;
  light.shadowTexel = fit.texel;
  if (matrix == 0) light.shadowLayer = static_cast<float>(layer);
  light.shadowLayers = static_cast<float>(matrix + 1);
}

float typeNumber(LightType type) {
  switch (type) {
    case LightType::directional:
      return LIGHT_DIRECTIONAL;
    case LightType::point:
      return LIGHT_POINT;
    case LightType::spot:
      return LIGHT_SPOT;
    case LightType::rectangle:
      return LIGHT_RECTANGLE;
    case LightType::sphere:
      break;
  }
  return LIGHT_SPHERE;
}

// Candela per nit in the direction of most.
float areaOf(const Light& light) {
  return light.type == LightType::rectangle ? light.width * light.height
         : light.type == LightType::sphere  ? glm::pi<float>() * light.radius * light.radius
                                            : 1.0f;
}

void addExtent(shared::GpuLight& light, const Light& source) {
  constexpr float kLeast = 1e-36f;
  light.radius = source.radius;
  light.area = std::max(areaOf(source), kLeast);
  light.color *= light.area;
  if (source.type != LightType::rectangle) return;
  light.coneScale = 1;
  const vec3 across = glm::cross(source.up, light.direction);
  const vec3 width =
      glm::length(across) > 1e-4f * glm::length(source.up) ? glm::normalize(across) : anyPerpendicular(light.direction);
  light.halfWidth = 0.5f * source.width * width;
  light.halfHeight = 0.5f * source.height * glm::cross(light.direction, width);
}

shared::GpuLight makeLight(vec3 direction, const vec3& color) {
  shared::GpuLight light{};
  light.direction = direction;
  light.color = color;
  light.shadowLayer = NO_SHADOW;
  return light;
}

void addLight(LightList& list, const Nested& nested, const Bounds& core, const Light& source, bool shadowed,
              int resolution) {
  const Bounds& bounds = nested.boxes.back();
  const float length = glm::length(source.direction);
  const vec3 direction = length > 0 ? source.direction / length : vec3(0, -1, 0);
  shared::GpuLight light = makeLight(direction, source.color * source.intensity);
  light.type = typeNumber(source.type);
  light.position = source.position;
  light.range = source.range;
  if (source.type == LightType::spot) {
    const float inner = std::cos(source.innerConeAngle), outer = std::cos(source.outerConeAngle);
    light.coneScale = 1.0f / std::max(1e-3f, inner - outer);
    light.coneOffset = -outer * light.coneScale;
  }
  if (source.type == LightType::rectangle || source.type == LightType::sphere) addExtent(light, source);
  const glm::ivec4 whole(0, 0, resolution, resolution);
  const vec3 side = std::abs(direction.y) > 0.99f ? vec3(1, 0, 0) : vec3(0, 1, 0);
  if (!shadowed) {
    list.lights.push_back(light);
    return;
  }
  if (source.type == LightType::directional) {
    int layer = 0;
    const auto add = [&](const Fit& fit) {
      addView(list, light, layer, fit, list.layers + layer, whole, resolution);
      ++layer;
    };
    if (nested.seen) add({fitLightSpace(bounds, *nested.seen, direction, resolution, kMargin)});
    for (const Bounds& box : nested.boxes) add(fitOrthographic(bounds, box, direction, resolution));
  } else {
    // Room for the filter beyond the cone or the cube's edge.
    const float room = 1 + 2.0f * static_cast<float>(kMargin) / static_cast<float>(resolution);
    if (layersOf(source, nested.layers()) == 1) {
      const float spread = room * std::tan(std::max(source.outerConeAngle, 0.01f));
      addView(list, light, 0, fitPerspective(bounds, core, source, direction, side, spread, resolution), list.layers,
              whole, resolution);
    } else {
      for (int face = 0; face < 6; ++face) {  // +x, -x, +y, -y, +z, -z
        vec3 axis(0);
        axis[face / 2] = face % 2 ? -1.0f : 1.0f;
        const vec3 up = face / 2 == 1 ? vec3(0, 0, 1) : vec3(0, 1, 0);
        addView(list, light, face, fitPerspective(bounds, core, source, axis, up, room, resolution), list.layers + face,
                whole, resolution);
      }
    }
  }
  list.layers += layersOf(source, nested.layers());
  list.lights.push_back(light);
}

void addSky(LightList& list, const Bounds& bounds, const SkyLight& sky, const Shares& shares, int resolution) {
  int tile = 0;
  const int perSide = resolution / shares.tile;
  for (const SkyDirection& direction : sky.directions) {
    shared::GpuLight light = makeLight(-direction.direction, direction.irradiance);
    const int inLayer = tile % shares.tilesPerLayer;
    const glm::ivec4 rectangle(inLayer % perSide * shares.tile, inLayer / perSide * shares.tile, shares.tile,
                               shares.tile);
    addView(list, light, 0, fitOrthographic(bounds, bounds, -direction.direction, shares.tile),
            list.layers + tile / shares.tilesPerLayer, rectangle, resolution);
    list.lights.push_back(light);
    ++tile;
  }
  list.layers += (tile + shares.tilesPerLayer - 1) / shares.tilesPerLayer;
}

// Mean irradiance, over the six sides of the bounds seen from inside, of all lights but the sky.
vec3 meanIrradiance(const Bounds& bounds, std::span<const Light> lights) {
  const vec3 size = bounds.extent();
  const vec3 sides(size.y * size.z, size.z * size.x, size.x * size.y);
  const float area = 2 * (sides.x + sides.y + sides.z);
  vec3 flux(0);
  for (const Light& light : lights) {
    const vec3 power = light.color * light.intensity * areaOf(light);
    const float length = std::max(glm::length(light.direction), 1e-20f);
    if (light.type == LightType::directional) {
      flux += power * glm::dot(glm::abs(light.direction / length), sides);
    } else if (light.type == LightType::rectangle) {
      flux += power * glm::pi<float>();
    } else {
      const float half = light.type == LightType::spot ? light.outerConeAngle : glm::pi<float>();
      flux += power * 2.0f * glm::pi<float>() * (1 - std::cos(half));
    }
  }
  return flux / area;
}

void addHemisphere(LightList& list, const vec3& from, const vec3& irradiance, float steady) {
  if (irradiance == vec3(0)) return;
  shared::GpuLight light = makeLight(-from, irradiance);
  light.steadyShare = steady;
  list.lights.push_back(light);
  ++list.ranges.hemispheres;
}

}  // namespace

LightList makeLightList(const Bounds& sceneBounds, std::span<const Light> lights, const Sky& sky,
                        const LightListLimits& limits, const ShadowBoxes& boxes) {
  const Bounds bounds = solid(sceneBounds), core = boxes.core.empty() ? bounds : solid(boxes.core);
  Nested nested;
  if (boxes.seen.corners.empty())
    for (const Bounds& box : boxes.around) nested.boxes.push_back(solid(box));
  else
    nested.seen = &boxes.seen;
  const std::size_t around = nested.boxes.size();
  if (!boxes.core.empty()) nested.boxes.push_back(core);
  nested.boxes.push_back(bounds);
  LightList list;
  keepRoomForLights(lights, limits, around, nested, list.warnings);
  const Shares shares = share(lights, limits, nested.layers(), list.warnings);
  for (std::size_t i = 0; i < lights.size(); ++i)
    addLight(list, nested, core, lights[i], i < shares.shadowed, limits.resolution);
  list.ranges.direct = static_cast<std::uint32_t>(lights.size());
  list.ranges.mapped = limits.mapsOfLights ? list.ranges.direct : 0;

  const SkyLight skyLight = integrateSky(sky, shares.directions);
  addSky(list, bounds, skyLight, shares, limits.resolution);
  list.ranges.skyDirections = static_cast<std::uint32_t>(skyLight.directions.size());
  const vec3 up(0, 1, 0);
  if (shares.directions == 0) addHemisphere(list, up, skyLight.upper, 1);
  // Light that other surfaces send on: most of it from below, a third as much from above. A black sky asks for direct
  // light alone.
  const bool black = skyLight.upper == vec3(0) && skyLight.lower == vec3(0);
  const vec3 bounce = black ? vec3(0) : kBounced * meanIrradiance(bounds, lights);
  addHemisphere(list, -up, skyLight.lower + bounce, kSteadyBounce);
  addHemisphere(list, up, bounce / 3.0f, kSteadyBounce);
  return list;
}

}  // namespace halfsilver
