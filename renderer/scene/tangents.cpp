#include "scene/tangents.h"

#include <cmath>
#include <cstring>
#include <string_view>
#include <unordered_map>

namespace halfsilver {
namespace {

using Corners = std::array<std::uint32_t, 3>;

// Vertices with equal keys (as bytes) share a tangent.
struct Key {
  glm::vec3 position, normal;
  glm::vec2 uv;
  float orientation;
  bool operator==(const Key& other) const { return std::memcmp(this, &other, sizeof(Key)) == 0; }
};
static_assert(sizeof(Key) == 9 * sizeof(float), "keys are compared as bytes");

struct KeyHash {
  std::size_t operator()(const Key& key) const {
    return std::hash<std::string_view>()({reinterpret_cast<const char*>(&key), sizeof(Key)});
  }
};

struct Frame {
  glm::dvec3 alongU{0};
  float sign = 0;  // of the bitangent; 0 if the texture coordinates span no area
};

Frame faceFrame(const std::array<glm::dvec3, 3>& p, const std::array<glm::dvec2, 3>& uv) {
  const glm::dvec3 e1 = p[1] - p[0], e2 = p[2] - p[0];
  const glm::dvec2 d1 = uv[1] - uv[0], d2 = uv[2] - uv[0];
  const double area = d1.x * d2.y - d2.x * d1.y;
  const glm::dvec3 along = (area < 0 ? -1.0 : 1.0) * (d2.y * e1 - d1.y * e2);
  if (area == 0 || !std::isfinite(area) || !(glm::dot(along, along) > 0)) return {};
  return {glm::normalize(along), area > 0 ? -1.0f : 1.0f};
}

glm::dvec3 onPlane(const glm::dvec3& v, const glm::dvec3& normal) {
  const glm::dvec3 laid = v - normal * glm::dot(normal, v);
  const double length = glm::length(laid);
  return length > 0 ? laid / length : glm::dvec3(0);
}

}  // namespace

glm::vec3 anyPerpendicular(const glm::vec3& normal) {
  // Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017.
  const float sign = std::copysign(1.0f, normal.z);
  const float a = -1.0f / (sign + normal.z);
  return glm::normalize(
      glm::vec3(1 + sign * normal.x * normal.x * a, sign * normal.x * normal.y * a, -sign * normal.x));
}

std::vector<std::uint32_t> makeTangents(std::vector<Vertex>& vertices, std::span<Corners> triangles, std::size_t uvSet,
                                        const std::array<glm::vec3, 2>& transform) {
  const auto uvOf = [&](const Vertex& v) {
    const glm::dvec3 uv(v.uv[uvSet], 1);
    return glm::dvec2(glm::dot(glm::dvec3(transform[0]), uv), glm::dot(glm::dvec3(transform[1]), uv));
  };
  std::vector<std::uint32_t> copied;
  std::vector<float> orientation(vertices.size(), 0);
  std::unordered_map<std::uint32_t, std::uint32_t> mirror;  // the copy of a vertex with the other orientation
  std::unordered_map<Key, glm::dvec3, KeyHash> sums;
  const auto keyOf = [&](const Vertex& v, float sign) {
    // Adding zero turns -0 into 0, which as bytes would differ.
    return Key{v.position + 0.0f, v.normal + 0.0f, v.uv[uvSet] + 0.0f, sign};
  };

  for (Corners& triangle : triangles) {
    std::array<glm::dvec3, 3> p;
    std::array<glm::dvec2, 3> uv;
    for (std::size_t k = 0; k < 3; ++k) {
      p[k] = vertices[triangle[k]].position;
      uv[k] = uvOf(vertices[triangle[k]]);
    }
    const Frame frame = faceFrame(p, uv);
    if (frame.sign == 0) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      std::uint32_t& index = triangle[k];
      if (orientation[index] == 0) orientation[index] = frame.sign;
      if (orientation[index] != frame.sign) {
        const auto [found, added] = mirror.try_emplace(index, static_cast<std::uint32_t>(vertices.size()));
        if (added) {
          vertices.push_back(Vertex(vertices[index]));
          orientation.push_back(frame.sign);
          copied.push_back(index);
        }
        index = found->second;
      }
      const Vertex& vertex = vertices[index];
      const glm::dvec3 normal(vertex.normal);
      const glm::dvec3 a = onPlane(p[(k + 1) % 3] - p[k], normal), b = onPlane(p[(k + 2) % 3] - p[k], normal);
      const double angle = std::acos(glm::clamp(glm::dot(a, b), -1.0, 1.0));
      sums[keyOf(vertex, frame.sign)] += angle * onPlane(frame.alongU, normal);
    }
  }
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    Vertex& vertex = vertices[i];
    const float sign = orientation[i] == 0 ? 1.0f : orientation[i];
    const auto found = sums.find(keyOf(vertex, sign));
    const glm::dvec3 tangent = found == sums.end() ? glm::dvec3(0) : onPlane(found->second, glm::dvec3(vertex.normal));
    vertex.tangent = glm::vec4(tangent == glm::dvec3(0) ? anyPerpendicular(vertex.normal) : glm::vec3(tangent), sign);
  }
  return copied;
}

}  // namespace halfsilver
