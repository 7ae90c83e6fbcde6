#include "frame/light_tables.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/gtc/constants.hpp>
#include <vector>

namespace halfsilver {
namespace {

using glm::clamp;
using glm::mix;
using glm::smoothstep;
using glm::vec3;
#include "shared/sky.h"

constexpr gl::TexelFormat kPairs{GL_RG32UI, 8};
// Of the choices of a cell: all can be chosen, since a texel between two cells is interpolated.
constexpr double kEven = 0.05;

double brightness(const vec3& light) {
  const glm::dvec3 color = glm::max(glm::dvec3(light), 0.0);
  return glm::dot(color, glm::dvec3(0.2126, 0.7152, 0.0722));
}

struct Cells {
  int rows, columns;
  std::vector<double> light;  // row by row, the first looks up
};

Cells cellsOf(const Sky& sky) {
  constexpr int kMaxRows = 128, kMaxColumns = 256;
  if (sky.image.empty()) {
    Cells cells{kMaxRows, 1, {}};
    for (int row = 0; row < kMaxRows; ++row) {
      const float up = 1 - 2 * (static_cast<float>(row) + 0.5f) / kMaxRows;
      cells.light.push_back(brightness(skyGradient(sky.zenith, sky.horizon, sky.ground, up, 0)));
    }
    return cells;
  }
  // Rows of an image are densest at the horizon: no cell may lie between two.
  const int rows = std::clamp(static_cast<int>(2 * sky.imageHeight / glm::pi<double>()), 1, kMaxRows);
  Cells cells{rows, std::min(sky.imageWidth, kMaxColumns), {}};
  cells.light.assign(static_cast<std::size_t>(cells.rows) * static_cast<std::size_t>(cells.columns), 0);
  for (int y = 0; y < sky.imageHeight; ++y) {
    const double angle = glm::pi<double>() * (y + 0.5) / sky.imageHeight;
    const int row = std::min(static_cast<int>(0.5 * (1 - std::cos(angle)) * cells.rows), cells.rows - 1);
    for (int x = 0; x < sky.imageWidth; ++x) {
      const int column = static_cast<int>(static_cast<std::int64_t>(x) * cells.columns / sky.imageWidth);
      const std::size_t texel =
          3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(sky.imageWidth) + static_cast<std::size_t>(x));
      const double light = brightness({sky.image[texel], sky.image[texel + 1], sky.image[texel + 2]});
      const std::size_t cell =
          static_cast<std::size_t>(row) * static_cast<std::size_t>(cells.columns) + static_cast<std::size_t>(column);
      if (std::isfinite(light)) cells.light[cell] += light * std::sin(angle);
    }
  }
  return cells;
}

// Sums of the values so far over the sum of all; even steps if that is 0.
std::vector<float> cumulative(const std::vector<double>& values) {
  double all = 0, sum = 0;
  for (const double value : values) all += value;
  std::vector<float> result;
  for (const double value : values) {
    sum += all > 0 ? value / all : 1 / static_cast<double>(values.size());
    result.push_back(static_cast<float>(std::min(sum, 1.0)));
  }
  if (!result.empty()) result.back() = 1;
  return result;
}

}  // namespace

LightTable makeEmitters(const gl::Api& api, const Scene& scene) {
  std::vector<std::uint32_t> numbers;
  std::vector<double> light;
  for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
    const Material& material = scene.materials[scene.triangles[t].material];
    const double bright = material.unlit && !material.mirror ? 0 : brightness(material.emissive);
    if (!(bright > 0)) continue;
    const auto corner = [&](std::size_t i) {
      return glm::dvec3(scene.vertices[scene.triangles[t].vertices[i]].position);
    };
    const double area = glm::length(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
    numbers.push_back(static_cast<std::uint32_t>(t));
    light.push_back(std::max(area, 1e-30) * bright);
  }
  const std::vector<float> sums = cumulative(light);
  std::vector<glm::uvec2> entries;
  for (std::size_t i = 0; i < numbers.size(); ++i) entries.emplace_back(numbers[i], glm::floatBitsToUint(sums[i]));
  return {gl::makeTexelBuffer(api, std::span<const glm::uvec2>(entries), "emitters", kPairs),
          static_cast<std::uint32_t>(entries.size())};
}

SkyTable makeSkyTable(const gl::Api& api, const Sky& sky) {
  Cells cells = cellsOf(sky);
  double all = 0;
  for (const double light : cells.light) all += light;
  const double floor = kEven * all / static_cast<double>(cells.light.size());
  std::vector<double> rows;
  std::vector<float> table;
  for (int row = 0; row < cells.rows; ++row) {
    const auto first = cells.light.begin() + static_cast<std::ptrdiff_t>(row) * cells.columns;
    std::vector<double> columns(first, first + cells.columns);
    double sum = 0;
    for (double& light : columns) sum += light += floor;
    rows.push_back(sum);
    const std::vector<float> sums = cumulative(columns);
    table.insert(table.end(), sums.begin(), sums.end());
  }
  const std::vector<float> sums = cumulative(rows);
  table.insert(table.begin(), sums.begin(), sums.end());
  return {gl::makeTexelBuffer(api, std::span<const float>(table), "sky table", {GL_R32F, 4}),
          static_cast<std::uint32_t>(cells.rows), static_cast<std::uint32_t>(cells.columns),
          all > 0 && sky.intensity > 0};
}

}  // namespace halfsilver
