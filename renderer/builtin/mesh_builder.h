#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <initializer_list>
#include <span>
#include <vector>

#include <halfsilver/scene.h>

// Triangles from parametric pieces, for the scenes that are made in code. Everything is computed in double precision
// and rounded to float once, so that the meshes are the same on every machine. Lengths are meters.
//
// One rule holds for all pieces: seen from the front, columns run to the right and rows run down. Triangles are then
// counter-clockwise, u grows to the right, v grows down, and the tangent frame's sign is always +1.
namespace halfsilver {

inline constexpr double kPi = 3.14159265358979323846;

// The outline of a molding in a plane with axes (a, b), built piece by piece. Walking along it, the outside lies to
// the left: down the right-hand side of a shape, for instance. Each piece is smooth; pieces meet in hard edges.
class Profile {
 public:
  struct Point {
    glm::dvec2 position;
    glm::dvec2 normal;  // unit
    double length;      // along the profile from its beginning
  };

  Profile& lines(std::initializer_list<glm::dvec2> points);  // flat pieces
  Profile& curve(std::span<const glm::dvec2> points);        // one smooth piece through at least two points
  // Angles in radians, 0 along +a, counter-clockwise positive; `to` < `from` bulges outward.
  Profile& arc(glm::dvec2 center, double radius, double from, double to, int segments);

  const std::vector<std::vector<Point>>& pieces() const { return pieces_; }

 private:
  void add(std::vector<Point> piece);
  std::vector<std::vector<Point>> pieces_;
  double length_ = 0;
};

// Where a profile is placed along a sweep: its plane is origin + x * a + y * b. Stations advance along cross(b, a).
struct Station {
  glm::dvec3 origin{0};
  glm::dvec3 a{1, 0, 0}, b{0, 1, 0};  // unit, perpendicular
  double distance = 0;                // along the sweep, for the texture
};

struct SurfacePoint {
  glm::dvec3 position{0};
  glm::dvec3 normal{0, 1, 0};
  glm::dvec3 tangent{1, 0, 0};  // toward growing u; made perpendicular to the normal when added
  glm::dvec2 uv{0};
};

// A rotation about the y axis, then a translation.
struct Placement {
  glm::dvec3 shift{0};
  double turn = 0;  // radians, counter-clockwise seen from above
};

struct Mesh {
  std::vector<Vertex> vertices;
  std::vector<Triangle> triangles;
};

enum BoxFaces : unsigned {
  kFaceLeft = 1,
  kFaceRight = 2,
  kFaceBottom = 4,
  kFaceTop = 8,
  kFaceBack = 16,
  kFaceFront = 32,
  kAllFaces = 63
};

class MeshBuilder {
 public:
  // Sets the material of the pieces that follow.
  MeshBuilder& use(std::uint32_t material, double metersPerTexture = 1, glm::vec4 color = glm::vec4(1));

  void reserve(std::size_t vertices, std::size_t triangles);
  std::uint32_t vertex(const SurfacePoint& point);
  // Leaves out triangles without area.
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);

  // point(column, row) for 0..columns and 0..rows.
  template <class PointAt>
  void grid(int columns, int rows, PointAt&& point) {
    const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
    for (int row = 0; row <= rows; ++row)
      for (int column = 0; column <= columns; ++column) vertex(point(column, row));
    connect(first, columns, rows);
  }

  // A grid of position(s, t), both 0..1, with normals from the function's derivatives; the texture covers it
  // `repeats` times.
  template <class PositionAt>
  void surface(int columns, int rows, glm::dvec2 repeats, PositionAt&& position) {
    constexpr double kStep = 1e-4;
    grid(columns, rows, [&](int column, int row) {
      const double s = static_cast<double>(column) / columns;
      const double t = static_cast<double>(row) / rows;
      SurfacePoint p;
      p.position = position(s, t);
      p.tangent = position(s + kStep, t) - position(s - kStep, t);
      p.normal = glm::normalize(glm::cross(position(s, t + kStep) - position(s, t - kStep), p.tangent));
      p.uv = glm::dvec2(s, t) * repeats;
      return p;
    });
  }

  void sweep(const Profile& profile, std::span<const Station> stations);
  // Straight along cross(b, a).
  void extrude(const Profile& profile, glm::dvec3 start, glm::dvec3 a, glm::dvec3 b, double length);
  // About an axis; the profile's a is the distance from it, its b runs along it.
  void lathe(const Profile& profile, glm::dvec3 base, int segments, glm::dvec3 axis = glm::dvec3(0, 1, 0));
  // About `center`; the profile's b is the distance from it, starting along `start` (unit), its a is `a`, the axis.
  void sweepArc(const Profile& profile, glm::dvec3 center, glm::dvec3 a, glm::dvec3 start, double angle, int segments);
  // A round bar through the points; `side` is not parallel to any part of it. Open bars get flat ends.
  void tube(std::span<const glm::dvec3> points, double radius, int sides, glm::dvec3 side, bool closed = false);
  // A disc around its center, seen from the tip of `normal`.
  void disc(glm::dvec3 center, glm::dvec3 normal, double radius, int segments);

  // A parallelogram whose corner, right and down edges are given.
  void rectangle(glm::dvec3 corner, glm::dvec3 right, glm::dvec3 down);
  void box(glm::dvec3 low, glm::dvec3 high, unsigned faces = kAllFaces);
  // Edges rounded by `radius` in `segments` steps; turned about the y axis, standing on `base` (center of its foot).
  void roundedBox(glm::dvec3 base, glm::dvec3 size, double radius, int segments, double turn = 0);
  // A wall of half-width `halfWidth` and height `height` above the springing line of a semicircular opening.
  void archedWall(glm::dvec3 springing, glm::dvec3 right, glm::dvec3 up, double halfWidth, double height, double radius,
                  int segments);

  void append(const Mesh& mesh, const Placement& placement);

  const Mesh& mesh() const { return mesh_; }
  Mesh take() { return std::move(mesh_); }

 private:
  void connect(std::uint32_t first, int columns, int rows);
  // Texture coordinates by the position in the world, so that neighboring pieces continue each other.
  SurfacePoint planar(glm::dvec3 position, glm::dvec3 normal) const;
  void flatQuad(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c, glm::dvec3 d);  // counter-clockwise

  Mesh mesh_;
  std::uint32_t material_ = 0;
  double metersPerTexture_ = 1;
  glm::vec4 color_{1};
};

}  // namespace halfsilver
