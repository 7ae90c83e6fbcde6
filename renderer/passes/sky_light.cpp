#include "passes/sky_light.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <span>

namespace halfsilver {
namespace {

using glm::clamp;
using glm::mix;
using glm::smoothstep;
using glm::vec3;
#include "shared/sky.h"

constexpr double kPi = glm::pi<double>();
constexpr float kBrightest = 65504;  // of a texel: what a half float holds

// A patch of the sphere of directions.
struct Patch {
  vec3 direction;
  vec3 radiance;
  float solidAngle;
};

// Mean radiance of a patch: rows and columns as fractions of the sphere, row 0 is straight up.
vec3 imageMean(const Sky& sky, double top, double bottom, double left, double right) {
  const auto firstTexel = [](double place, int size) { return std::min(static_cast<int>(place * size), size - 1); };
  const auto lastTexel = [&](double place, int size) {
    return std::clamp(static_cast<int>(std::ceil(place * size)) - 1, 0, size - 1);
  };
  const int y0 = firstTexel(top, sky.imageHeight), y1 = std::max(y0, lastTexel(bottom, sky.imageHeight));
  const int x0 = firstTexel(left, sky.imageWidth), x1 = std::max(x0, lastTexel(right, sky.imageWidth));
  glm::dvec3 sum(0);
  double weights = 0;
  for (int y = y0; y <= y1; ++y) {
    const double weight = std::sin(kPi * (y + 0.5) / sky.imageHeight);
    for (int x = x0; x <= x1; ++x) {
      const std::size_t texel =
          3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(sky.imageWidth) + static_cast<std::size_t>(x));
      for (int c = 0; c < 3; ++c) {
        const float value = sky.image[texel + static_cast<std::size_t>(c)];
        sum[c] += value > 0 ? weight * std::min(value, kBrightest) : 0;  // false for NaN
      }
      weights += weight;
    }
  }
  return vec3(sum / weights);
}

std::vector<Patch> patches(const Sky& sky) {
  constexpr int kRows = 64, kColumns = 128;  // even: no patch crosses the horizon
  const bool image = sky.imageWidth > 0 && sky.imageHeight > 0 && !sky.image.empty();
  std::vector<Patch> all;
  all.reserve(kRows * kColumns);
  for (int row = 0; row < kRows; ++row) {
    const double top = std::cos(kPi * row / kRows), bottom = std::cos(kPi * (row + 1) / kRows);
    const double up = 0.5 * (top + bottom);  // the mean of the patch, so that integrals of `up` are exact
    const double around = std::sqrt(1 - up * up);
    for (int column = 0; column < kColumns; ++column) {
      const double angle = 2 * kPi * ((column + 0.5) / kColumns - 0.5);  // u = 0.5 + atan2(x, -z) / 2 pi
      Patch patch;
      patch.direction = vec3(around * std::sin(angle), up, -around * std::cos(angle));
      patch.solidAngle = static_cast<float>((top - bottom) * 2 * kPi / kColumns);
      patch.radiance =
          sky.intensity *
          (image ? imageMean(sky, row / static_cast<double>(kRows), (row + 1) / static_cast<double>(kRows),
                             column / static_cast<double>(kColumns), (column + 1) / static_cast<double>(kColumns))
                 : skyGradient(sky.zenith, sky.horizon, sky.ground, static_cast<float>(up), 0.0f));
      all.push_back(patch);
    }
  }
  return all;
}

// Points of the upper half of the unit sphere (a Fibonacci spiral) that light a plane which faces up with equal parts
// of an even sky: most surfaces that see much of it face up, and for them equal areas of sky would make small change of
// the horizon. The turn is the one that errs least in scenes whose walls lie along the axes.
std::vector<vec3> spread(int count) {
  const double goldenAngle = kPi * (3 - std::sqrt(5.0)), turn = 0.75 * kPi;
  std::vector<vec3> points;
  for (int i = 0; i < count; ++i) {
    const double around = std::sqrt((i + 0.5) / count), up = std::sqrt(1 - around * around);
    const double angle = turn + goldenAngle * i;
    points.emplace_back(around * std::cos(angle), up, around * std::sin(angle));
  }
  return points;
}

std::size_t nearest(std::span<const vec3> points, const vec3& direction) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < points.size(); ++i)
    if (glm::dot(points[i], direction) > glm::dot(points[best], direction)) best = i;
  return best;
}

float luminance(const vec3& color) { return glm::dot(color, vec3(0.2126f, 0.7152f, 0.0722f)); }

}  // namespace

SkyLight integrateSky(const Sky& sky, int count) {
  const std::vector<Patch> all = patches(sky);
  const std::vector<vec3> points = spread(count);
  SkyLight light;
  std::vector<glm::mat3> flux(points.size(), glm::mat3(0));  // a column per color: radiance times direction
  for (const Patch& patch : all) {
    const vec3 power = patch.radiance * patch.solidAngle;
    (patch.direction.y > 0 ? light.upper : light.lower) += power * std::abs(patch.direction.y);
    if (points.empty() || patch.direction.y <= 0) continue;
    glm::mat3& share = flux[nearest(points, patch.direction)];
    for (int c = 0; c < 3; ++c) share[c] += power[c] * patch.direction;
  }
  for (const glm::mat3& share : flux) {
    const vec3 mean(luminance({share[0].x, share[1].x, share[2].x}), luminance({share[0].y, share[1].y, share[2].y}),
                    luminance({share[0].z, share[1].z, share[2].z}));
    const float length = glm::length(mean);
    if (!(length > 0)) continue;
    SkyDirection direction;
    direction.direction = mean / length;
    for (int c = 0; c < 3; ++c) direction.irradiance[c] = std::max(0.0f, glm::dot(share[c], direction.direction));
    light.directions.push_back(direction);
  }
  return light;
}

}  // namespace halfsilver
