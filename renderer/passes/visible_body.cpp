#include "passes/visible_body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "scene/tangents.h"

namespace halfsilver {
namespace {

using glm::vec3;
using glm::vec4;

// What is nearer than this share of the farthest counts as that far: the body may begin at the eye, but no map can be
// infinitely fine there.
constexpr float kNearest = 1.0f / 16;
// Sine of the angle between view and light; below it the map is all but uniform.
constexpr float kMinSine = 1e-3f;

// Adds the ends of what a line from `from` along `way`, at the parts low..high of it, has inside of all planes.
void addClipped(const vec3& from, const vec3& way, float low, float high, const std::vector<vec4>& planes,
                std::vector<vec3>& corners) {
  for (const vec4& plane : planes) {
    const float start = glm::dot(vec3(plane), from) + plane.w, slope = glm::dot(vec3(plane), way);
    if (slope > 0)
      low = std::max(low, -start / slope);
    else if (slope < 0)
      high = std::min(high, -start / slope);
    else if (start < 0)
      return;
  }
  if (low > high || !std::isfinite(high)) return;
  corners.push_back(from + low * way);
  corners.push_back(from + high * way);
}

}  // namespace

VisibleBody visibleBody(const Camera& camera, float aspect, const Bounds& bounds) {
  VisibleBody body;
  if (camera.parallelHeight > 0 || bounds.empty()) return body;
  const vec3 forward = glm::normalize(camera.target - camera.eye);
  vec3 across = glm::cross(forward, camera.up);
  if (!(glm::length(across) > 1e-6f * glm::length(camera.up)))  // as makeFrameConstants() has it
    across = glm::cross(forward, std::abs(forward.y) < 0.9f ? vec3(0, 1, 0) : vec3(0, 0, -1));
  const vec3 right = glm::normalize(across), up = glm::cross(right, forward);
  const float tall = std::tan(0.5f * camera.verticalFov), wide = tall * aspect;
  body.eye = camera.eye;
  body.forward = forward;
  std::vector<vec4> view, box;  // inside where dot(plane, (p, 1)) >= 0
  for (const vec3& plane : {wide * forward - right, wide * forward + right, tall * forward - up, tall * forward + up})
    view.emplace_back(plane, -glm::dot(plane, camera.eye));
  for (int axis = 0; axis < 3; ++axis) {
    vec3 along(0);
    along[axis] = 1;
    box.emplace_back(along, -bounds.low[axis]);
    box.emplace_back(-along, bounds.high[axis]);
  }
  const vec3 extent = bounds.extent();
  for (unsigned corner = 0; corner < 8; ++corner)
    for (int axis = 0; axis < 3; ++axis) {
      if (corner >> axis & 1u) continue;
      vec3 from = bounds.low, way(0);
      for (int other = 0; other < 3; ++other)
        if (corner >> other & 1u) from[other] += extent[other];
      way[axis] = extent[axis];
      addClipped(from, way, 0, 1, view, body.corners);
    }
  for (const float x : {-wide, wide})
    for (const float y : {-tall, tall})
      addClipped(camera.eye, forward + x * right + y * up, 0, std::numeric_limits<float>::infinity(), box,
                 body.corners);
  return body;
}

glm::mat4 fitLightSpace(const Bounds& bounds, const VisibleBody& body, const vec3& direction, int size, int margin) {
  const vec3 projected = body.forward - direction * glm::dot(body.forward, direction);
  const float sine = glm::length(projected);
  const vec3 ahead = sine > kMinSine ? projected / sine : anyPerpendicular(direction);
  const vec3 right = glm::cross(ahead, direction);
  const auto seen = [&](const vec3& point) {
    const vec3 p = point - body.eye;
    return vec3(glm::dot(p, right), glm::dot(p, ahead), glm::dot(p, direction));
  };
  Bounds space;
  float nearest = std::numeric_limits<float>::max(), farthest = 0;
  for (const vec3& corner : body.corners) {
    space.add(seen(corner));
    const float away = glm::dot(corner - body.eye, body.forward);
    nearest = std::min(nearest, away);
    farthest = std::max(farthest, away);
  }
  for (unsigned i = 0; i < 8; ++i) {
    const float depth = seen({i & 1 ? bounds.high.x : bounds.low.x, i & 2 ? bounds.high.y : bounds.low.y,
                              i & 4 ? bounds.high.z : bounds.low.z})
                            .z;
    space.low.z = std::min(space.low.z, depth);
    space.high.z = std::max(space.high.z, depth);
  }
  const float length = std::max(space.extent().y, 1e-6f * bounds.diagonal());
  nearest = std::max(nearest, kNearest * farthest);
  const float begin = (nearest + std::sqrt(nearest * farthest)) / std::max(sine, kMinSine), end = begin + length;
  // w of clip coordinates, as a row over (seen(p), 1): the way from the perspective's center.
  const vec4 w(0, 1, 0, begin - space.low.y);

  float low = std::numeric_limits<float>::max(), high = -low;
  for (const vec3& corner : body.corners) {
    const vec3 p = seen(corner);
    low = std::min(low, p.x / glm::dot(w, vec4(p, 1)));
    high = std::max(high, p.x / glm::dot(w, vec4(p, 1)));
  }
  const float inner = static_cast<float>(size - 2 * std::min(margin, size / 4)) / static_cast<float>(size);
  const float depth = 1.002f * space.extent().z, first = space.low.z - 0.001f * space.extent().z;
  const vec4 x =
      inner / std::max(0.5f * (high - low), 1e-6f * length / end) * (vec4(1, 0, 0, 0) - 0.5f * (low + high) * w);
  const vec4 y = inner / length * ((end + begin) * w - vec4(0, 0, 0, 2 * end * begin));
  const vec4 z = 2 * begin / depth * vec4(0, 0, 1, -first) - w;

  glm::mat4 worldToClip(0);
  const vec4 rows[4] = {x, y, z, w};
  for (int row = 0; row < 4; ++row) {
    const vec3 part = rows[row].x * right + rows[row].y * ahead + rows[row].z * direction;
    for (int column = 0; column < 3; ++column) worldToClip[column][row] = part[column];
    worldToClip[3][row] = rows[row].w - glm::dot(part, body.eye);
  }
  return worldToClip;
}

}  // namespace halfsilver
