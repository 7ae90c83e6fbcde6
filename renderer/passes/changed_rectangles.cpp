#include "passes/changed_rectangles.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "passes/view_culling.h"

namespace halfsilver {
namespace {

// Texels whose drawing costs as much as one more rectangle.
constexpr int kRectangleCost = 1024;

// Of texels; `high` is not part of it.
struct Rectangle {
  glm::ivec2 low{0}, high{0};

  bool empty() const { return low.x >= high.x || low.y >= high.y; }
  long long area() const { return static_cast<long long>(high.x - low.x) * (high.y - low.y); }
};

Rectangle join(const Rectangle& a, const Rectangle& b) { return {glm::min(a.low, b.low), glm::max(a.high, b.high)}; }

// Texels that two rectangles leave out and their join does not.
long long waste(const Rectangle& a, const Rectangle& b) { return join(a, b).area() - a.area() - b.area(); }

// The corners of the part of a box that lies before the near plane, in clip coordinates.
std::vector<glm::vec4> clippedCorners(const glm::mat4& worldToClip, const Bounds& box) {
  std::array<glm::vec4, 8> corners;
  for (unsigned i = 0; i < 8; ++i)
    corners[i] = worldToClip * glm::vec4(i & 1 ? box.high.x : box.low.x, i & 2 ? box.high.y : box.low.y,
                                         i & 4 ? box.high.z : box.low.z, 1);
  const auto before = [](const glm::vec4& corner) { return corner.z + corner.w; };
  std::vector<glm::vec4> all;
  for (unsigned i = 0; i < 8; ++i) {
    if (before(corners[i]) >= 0) all.push_back(corners[i]);
    for (unsigned bit = 1; bit < 8; bit *= 2) {
      const glm::vec4 &from = corners[i], &to = corners[i ^ bit];
      if (before(from) >= 0 && before(to) < 0)
        all.push_back(glm::mix(from, to, before(from) / (before(from) - before(to))));
    }
  }
  return all;
}

// How far from the exact value the device's clip coordinates of points in a box may be.
glm::vec4 slackOf(const glm::mat4& worldToClip, const Bounds& box) {
  const glm::vec3 largest = glm::max(glm::abs(box.low), glm::abs(box.high));
  glm::vec4 slack(0);
  for (int column = 0; column < 4; ++column)
    slack += glm::abs(worldToClip[column]) * (column < 3 ? largest[column] : 1.0f);
  return kClipRounding * slack;
}

Rectangle covered(const ShadowView& view, const Bounds& box) {
  const glm::ivec2 origin(view.rectangle.x, view.rectangle.y), size(view.rectangle.z, view.rectangle.w);
  const Rectangle whole{origin, origin + size};
  const glm::vec4 slack = slackOf(view.worldToClip, box);
  glm::vec2 low(1), high(-1);  // in -1..1
  for (const glm::vec4& corner : clippedCorners(view.worldToClip, box)) {
    if (corner.w <= slack.w) return whole;
    for (const float w : {corner.w - slack.w, corner.w + slack.w}) {
      low = glm::min(low, (glm::vec2(corner) - glm::vec2(slack)) / w);
      high = glm::max(high, (glm::vec2(corner) + glm::vec2(slack)) / w);
    }
  }
  const auto texels = [&](const glm::vec2& clip) {
    return (0.5f * glm::clamp(clip, -1.0f, 1.0f) + 0.5f) * glm::vec2(size);
  };
  return {glm::max(origin + glm::ivec2(glm::floor(texels(low))) - 1, whole.low),
          glm::min(origin + glm::ivec2(glm::ceil(texels(high))) + 1, whole.high)};
}

// Joins the pair that wastes the least, if that is at most `maxWaste`.
bool joinClosest(std::vector<Rectangle>& rectangles, long long maxWaste) {
  std::optional<std::array<std::size_t, 2>> closest;
  for (std::size_t a = 0; a < rectangles.size(); ++a)
    for (std::size_t b = a + 1; b < rectangles.size(); ++b)
      if (const long long wasted = waste(rectangles[a], rectangles[b]); wasted <= maxWaste) {
        maxWaste = wasted - 1;
        closest = {a, b};
      }
  if (!closest) return false;
  const auto [a, b] = *closest;
  rectangles[a] = join(rectangles[a], rectangles[b]);
  rectangles.erase(rectangles.begin() + static_cast<std::ptrdiff_t>(b));
  return true;
}

}  // namespace

std::vector<glm::ivec4> changedRectangles(const ShadowView& view, std::span<const Bounds> boxes) {
  const Frustum frustum(view.worldToClip);
  std::vector<Rectangle> rectangles;
  for (const Bounds& box : boxes) {
    if (!frustum.mayTouch(box)) continue;
    const Rectangle rectangle = covered(view, box);
    if (rectangle.empty()) continue;
    rectangles.push_back(rectangle);
    if (rectangles.size() > kMaxChangedRectangles) joinClosest(rectangles, std::numeric_limits<long long>::max());
  }
  while (joinClosest(rectangles, kRectangleCost)) {
  }
  std::vector<glm::ivec4> result;
  for (const Rectangle& each : rectangles) result.emplace_back(each.low, each.high - each.low);
  return result;
}

glm::mat4 clipTo(const ShadowView& view, const glm::ivec4& rectangle) {
  const glm::vec2 size(view.rectangle.z, view.rectangle.w);
  const glm::vec2 low = glm::vec2(rectangle.x - view.rectangle.x - 1, rectangle.y - view.rectangle.y - 1) / size;
  const glm::vec2 extent = glm::vec2(rectangle.z + 2, rectangle.w + 2) / size;
  // From -1..1 of the view to -1..1 of the rectangle.
  glm::mat4 crop(1);
  for (int axis = 0; axis < 2; ++axis) {
    crop[axis][axis] = 1 / extent[axis];
    crop[3][axis] = (1 - 2 * low[axis]) / extent[axis] - 1;
  }
  return crop * view.worldToClip;
}

}  // namespace halfsilver
