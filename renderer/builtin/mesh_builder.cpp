#include "builtin/mesh_builder.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace halfsilver {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr double kSmallestArea = 1e-9;  // square meters, twice the triangle's

dvec2 leftOf(dvec2 direction) { return glm::normalize(dvec2(-direction.y, direction.x)); }

// Multiples of a quarter turn come out exact.
dvec2 cosineSine(double angle) {
  const auto snap = [](double value) {
    const double whole = std::round(value);
    return std::abs(value - whole) < 1e-12 ? whole : value;
  };
  return {snap(std::cos(angle)), snap(std::sin(angle))};
}

dvec3 anyPerpendicular(dvec3 axis) {
  const dvec3 other = std::abs(axis.y) < 0.5 ? dvec3(0, 1, 0) : dvec3(0, 0, 1);
  return glm::normalize(other - axis * glm::dot(axis, other));
}

}  // namespace

void Profile::add(std::vector<Point> piece) {
  for (std::size_t i = 0; i < piece.size(); ++i) {
    if (i > 0) length_ += glm::distance(piece[i - 1].position, piece[i].position);
    piece[i].length = length_;
  }
  pieces_.push_back(std::move(piece));
}

Profile& Profile::lines(std::initializer_list<dvec2> points) {
  const dvec2* previous = nullptr;
  for (const dvec2& point : points) {
    if (previous) {
      const dvec2 normal = leftOf(point - *previous);
      add({{*previous, normal, 0}, {point, normal, 0}});
    }
    previous = &point;
  }
  return *this;
}

Profile& Profile::curve(std::span<const dvec2> points) {
  std::vector<Point> piece;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const dvec2 before = points[i] - points[i == 0 ? 0 : i - 1];
    const dvec2 after = points[std::min(i + 1, points.size() - 1)] - points[i];
    dvec2 normal(0);
    if (i > 0) normal += leftOf(before);
    if (i + 1 < points.size()) normal += leftOf(after);
    piece.push_back({points[i], glm::normalize(normal), 0});
  }
  add(std::move(piece));
  return *this;
}

Profile& Profile::arc(dvec2 center, double radius, double from, double to, int segments) {
  std::vector<Point> piece;
  const double outwards = to < from ? 1.0 : -1.0;
  for (int i = 0; i <= segments; ++i) {
    const dvec2 direction = cosineSine(from + (to - from) * i / segments);
    piece.push_back({center + radius * direction, outwards * direction, 0});
  }
  add(std::move(piece));
  return *this;
}

MeshBuilder& MeshBuilder::use(std::uint32_t material, double metersPerTexture, glm::vec4 color) {
  material_ = material;
  metersPerTexture_ = metersPerTexture;
  color_ = color;
  return *this;
}

void MeshBuilder::reserve(std::size_t vertices, std::size_t triangles) {
  mesh_.vertices.reserve(vertices);
  mesh_.triangles.reserve(triangles);
}

std::uint32_t MeshBuilder::vertex(const SurfacePoint& point) {
  const dvec3 normal = glm::normalize(point.normal);
  dvec3 tangent = point.tangent - normal * glm::dot(normal, point.tangent);
  const double length = glm::length(tangent);
  tangent = length > 1e-9 ? tangent / length : anyPerpendicular(normal);
  Vertex v;
  v.position = glm::vec3(point.position);
  v.normal = glm::vec3(normal);
  v.tangent = glm::vec4(glm::vec3(tangent), 1.0f);
  v.uv = {glm::vec2(point.uv), glm::vec2(0)};
  v.color = color_;
  mesh_.vertices.push_back(v);
  return static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
}

void MeshBuilder::triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  const dvec3 origin(mesh_.vertices[a].position);
  const dvec3 normal =
      glm::cross(dvec3(mesh_.vertices[b].position) - origin, dvec3(mesh_.vertices[c].position) - origin);
  if (glm::dot(normal, normal) < kSmallestArea * kSmallestArea) return;
  mesh_.triangles.push_back({{a, b, c}, material_});
}

void MeshBuilder::connect(std::uint32_t first, int columns, int rows) {
  const auto stride = static_cast<std::uint32_t>(columns + 1);
  for (std::uint32_t row = 0; row < static_cast<std::uint32_t>(rows); ++row)
    for (std::uint32_t column = 0; column < static_cast<std::uint32_t>(columns); ++column) {
      const std::uint32_t corner = first + row * stride + column;
      triangle(corner, corner + stride, corner + stride + 1);
      triangle(corner, corner + stride + 1, corner + 1);
    }
}

void MeshBuilder::sweep(const Profile& profile, std::span<const Station> stations) {
  for (const std::vector<Profile::Point>& piece : profile.pieces())
    grid(static_cast<int>(stations.size()) - 1, static_cast<int>(piece.size()) - 1, [&](int column, int row) {
      const Station& at = stations[static_cast<std::size_t>(column)];
      const Profile::Point& point = piece[static_cast<std::size_t>(row)];
      SurfacePoint result;
      result.position = at.origin + point.position.x * at.a + point.position.y * at.b;
      result.normal = point.normal.x * at.a + point.normal.y * at.b;
      result.tangent = glm::cross(at.b, at.a);
      result.uv = dvec2(at.distance, point.length) / metersPerTexture_;
      return result;
    });
}

void MeshBuilder::extrude(const Profile& profile, dvec3 start, dvec3 a, dvec3 b, double length) {
  const std::array<Station, 2> stations{Station{start, a, b, 0},
                                        Station{start + length * glm::cross(b, a), a, b, length}};
  sweep(profile, stations);
}

void MeshBuilder::lathe(const Profile& profile, dvec3 base, int segments, dvec3 axis) {
  double widest = 0;
  for (const auto& piece : profile.pieces())
    for (const Profile::Point& point : piece) widest = std::max(widest, point.position.x);
  const dvec3 first = anyPerpendicular(axis);
  const dvec3 second = glm::cross(axis, first);
  std::vector<Station> stations;
  for (int i = 0; i <= segments; ++i) {
    // The last station repeats the first's position: only the texture coordinate differs.
    const dvec2 direction = cosineSine(2 * kPi * (i % segments) / segments);
    stations.push_back({base, direction.x * first + direction.y * second, axis, 2 * kPi * widest * i / segments});
  }
  sweep(profile, stations);
}

void MeshBuilder::sweepArc(const Profile& profile, dvec3 center, dvec3 a, dvec3 start, double angle, int segments) {
  double radius = 0;
  for (const auto& piece : profile.pieces())
    for (const Profile::Point& point : piece) radius = std::max(radius, point.position.y);
  const dvec3 side = glm::cross(start, a);
  std::vector<Station> stations;
  for (int i = 0; i <= segments; ++i) {
    const double turned = angle * i / segments;
    const dvec2 direction = cosineSine(turned);
    stations.push_back({center, a, direction.x * start + direction.y * side, radius * turned});
  }
  sweep(profile, stations);
}

void MeshBuilder::tube(std::span<const dvec3> points, double radius, int sides, dvec3 side, bool closed) {
  const std::size_t count = points.size();
  Profile circle;
  circle.arc(dvec2(0), radius, 2 * kPi, 0, sides);
  std::vector<Station> stations;
  double distance = 0;
  for (std::size_t i = 0; i < count + (closed ? 1 : 0); ++i) {
    const dvec3 before = points[closed ? (i + count - 1) % count : (i == 0 ? 0 : i - 1)];
    const dvec3 after = points[closed ? (i + 1) % count : std::min(i + 1, count - 1)];
    const dvec3 along = glm::normalize(after - before);
    const dvec3 a = glm::normalize(side - along * glm::dot(along, side));
    if (i > 0) distance += glm::distance(points[i - 1], points[i % count]);
    stations.push_back({points[i % count], a, glm::cross(a, along), distance});
  }
  sweep(circle, stations);
  if (closed) return;
  disc(points.front(), glm::normalize(points[0] - points[1]), radius, sides);
  disc(points.back(), glm::normalize(points[count - 1] - points[count - 2]), radius, sides);
}

void MeshBuilder::disc(dvec3 center, dvec3 normal, double radius, int segments) {
  const dvec3 first = anyPerpendicular(normal);
  const dvec3 second = glm::cross(normal, first);
  const std::uint32_t middle = vertex(planar(center, normal));
  for (int i = 0; i < segments; ++i) {
    const dvec2 direction = cosineSine(2 * kPi * i / segments);
    vertex(planar(center + radius * (direction.x * first + direction.y * second), normal));
  }
  for (int i = 0; i < segments; ++i)
    triangle(middle, middle + 1 + static_cast<std::uint32_t>(i),
             middle + 1 + static_cast<std::uint32_t>((i + 1) % segments));
}

SurfacePoint MeshBuilder::planar(dvec3 position, dvec3 normal) const {
  const bool level = std::abs(normal.y) > 0.7071;
  const dvec3 right = level ? dvec3(1, 0, 0) : glm::normalize(glm::cross(dvec3(0, 1, 0), normal));
  const dvec3 up = glm::cross(normal, right);
  return {position, normal, right, dvec2(glm::dot(position, right), -glm::dot(position, up)) / metersPerTexture_};
}

void MeshBuilder::flatQuad(dvec3 a, dvec3 b, dvec3 c, dvec3 d) {
  const dvec3 normal = glm::normalize(glm::cross(c - a, d - b));
  const std::uint32_t first = vertex(planar(a, normal));
  vertex(planar(b, normal));
  vertex(planar(c, normal));
  vertex(planar(d, normal));
  triangle(first, first + 1, first + 2);
  triangle(first, first + 2, first + 3);
}

void MeshBuilder::rectangle(dvec3 corner, dvec3 right, dvec3 down) {
  flatQuad(corner, corner + down, corner + down + right, corner + right);
}

void MeshBuilder::box(dvec3 low, dvec3 high, unsigned faces) {
  const dvec3 x(high.x - low.x, 0, 0), y(0, high.y - low.y, 0), z(0, 0, high.z - low.z);
  if (faces & kFaceLeft) rectangle(low + y, z, -y);
  if (faces & kFaceRight) rectangle(high, -z, -y);
  if (faces & kFaceBottom) rectangle(low + z, x, -z);
  if (faces & kFaceTop) rectangle(low + y, x, z);
  if (faces & kFaceBack) rectangle(high - z, -x, -y);
  if (faces & kFaceFront) rectangle(high - x, x, -y);
}

void MeshBuilder::roundedBox(dvec3 base, dvec3 size, double radius, int segments, double turn) {
  const dvec3 half = 0.5 * size;
  const dvec3 inner = half - radius;
  const dvec2 rotation = cosineSine(turn);
  const int steps = 2 * segments + 1;
  // Offset from the middle along one axis: a rounded edge, the flat part, a rounded edge.
  const auto offset = [&](int step, double extent, double flat) {
    const int fromEnd = std::min(step, steps - step);
    const double bend = std::tan(0.25 * kPi * (segments - fromEnd) / segments);
    const double reach = fromEnd == 0 ? extent : flat + radius * bend;
    return step <= segments ? -reach : reach;
  };
  constexpr std::array<std::array<int, 3>, 6> kFaces{
      {{0, 2, 1}, {0, 1, 2}, {1, 0, 2}, {1, 2, 0}, {2, 1, 0}, {2, 0, 1}}};
  for (std::size_t face = 0; face < kFaces.size(); ++face) {
    const int axis = kFaces[face][0], across = kFaces[face][1], along = kFaces[face][2];
    const double sign = face % 2 == 0 ? -1.0 : 1.0;
    grid(steps, steps, [&](int column, int row) {
      dvec3 outer;
      outer[axis] = sign * half[axis];
      outer[across] = offset(column, half[across], inner[across]);
      outer[along] = -offset(row, half[along], inner[along]);
      const dvec3 core = glm::clamp(outer, -inner, inner);
      const dvec3 normal = glm::normalize(outer - core);
      dvec3 position = core + radius * normal;
      SurfacePoint point;
      dvec3 right(0);
      right[across] = 1;
      const auto rotate = [&](dvec3 v) {
        return dvec3(rotation.x * v.x + rotation.y * v.z, v.y, rotation.x * v.z - rotation.y * v.x);
      };
      point.uv = dvec2(position[across], -position[along]) / metersPerTexture_;
      point.position = base + rotate(position + dvec3(0, half.y, 0));
      point.normal = rotate(normal);
      point.tangent = rotate(right);
      return point;
    });
  }
}

void MeshBuilder::archedWall(dvec3 springing, dvec3 right, dvec3 up, double halfWidth, double height, double radius,
                             int segments) {
  const dvec3 normal = glm::cross(right, up);
  std::vector<dvec2> edge;  // bottom edge of the wall, left to right
  edge.emplace_back(-halfWidth, 0);
  for (int i = 0; i <= segments; ++i) {
    const dvec2 direction = cosineSine(kPi * (segments - i) / segments);
    edge.push_back(radius * direction);
  }
  edge.emplace_back(halfWidth, 0);
  grid(static_cast<int>(edge.size()) - 1, 1, [&](int column, int row) {
    const dvec2 at = edge[static_cast<std::size_t>(column)];
    return planar(springing + at.x * right + (row == 0 ? height : at.y) * up, normal);
  });
}

void MeshBuilder::append(const Mesh& mesh, const Placement& placement) {
  const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
  const dvec2 rotation = cosineSine(placement.turn);
  const auto rotate = [&](glm::vec3 v) {
    return dvec3(rotation.x * v.x + rotation.y * v.z, v.y, rotation.x * v.z - rotation.y * v.x);
  };
  for (Vertex v : mesh.vertices) {
    v.position = glm::vec3(rotate(v.position) + placement.shift);
    v.normal = glm::vec3(rotate(v.normal));
    v.tangent = glm::vec4(glm::vec3(rotate(glm::vec3(v.tangent))), v.tangent.w);
    mesh_.vertices.push_back(v);
  }
  for (Triangle t : mesh.triangles) {
    for (std::uint32_t& index : t.vertices) index += first;
    mesh_.triangles.push_back(t);
  }
}

}  // namespace halfsilver
