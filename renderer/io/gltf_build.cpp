#include "io/gltf_build.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <sstream>

#include <halfsilver/error.h>
#include "io/gltf_animations.h"
#include "io/gltf_materials.h"
#include "io/gltf_meshes.h"
#include "io/gltf_nodes.h"
#include "scene/pose.h"

namespace halfsilver::gltf {
namespace {

// Squared areas and squared diagonals of larger scenes exceed the range of floats.
constexpr double kLargestExtent = 1e9;
constexpr double kLargestCoordinate = 1e30;
constexpr std::size_t kMaxVertices = std::size_t{1} << 25;
constexpr std::size_t kMaxTriangles = std::size_t{1} << 25;

// Bounds in double precision.
struct WorldBounds {
  glm::dvec3 low{std::numeric_limits<double>::max()};
  glm::dvec3 high{std::numeric_limits<double>::lowest()};
  void add(const glm::dvec3& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
};

// The origin of relative coordinates: zero or, if the scene is far from zero for its size, a round point near its
// center: the nearest multiple of a power of two, so that subtracting it is exact.
glm::dvec3 chooseOrigin(const WorldBounds& bounds) {
  constexpr double kFar = 32;  // sizes
  const double extent = glm::length(bounds.high - bounds.low);
  const double size = extent > 0 ? extent : 1;  // a point at rest grows to something as it is animated
  const glm::dvec3 center = 0.5 * bounds.low + 0.5 * bounds.high;
  if (!(glm::length(center) > kFar * size)) return glm::dvec3(0);
  const double step = std::exp2(std::ceil(std::log2(size)));
  return glm::round(center / step) * step;
}

// In double precision differences and products of floats are exact: the same answer on every machine.
double squaredNormal(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  const glm::dvec3 normal = glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
  return glm::dot(normal, normal);
}

// Zero area in its own space is zero area wherever a node puts it, but rounding there may hide it.
bool hasArea(const Instance& shape, const std::array<std::uint32_t, 3>& t) {
  return squaredNormal(shape.rest[t[0]].position, shape.rest[t[1]].position, shape.rest[t[2]].position) > 0;
}

// Whether a shader can compute a normal in single precision: the squared area is a normal float, and the cross product
// is larger than its own rounding errors.
bool hasNormal(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  constexpr double kSine = 1.0 / (1 << 22);
  const glm::dvec3 ab = glm::dvec3(b) - glm::dvec3(a), ac = glm::dvec3(c) - glm::dvec3(a);
  const double squared = squaredNormal(a, b, c);
  return squared >= static_cast<double>(std::numeric_limits<float>::min()) &&
         squared > kSine * kSine * glm::dot(ab, ab) * glm::dot(ac, ac);
}

Light sun() {
  Light light;
  light.direction = glm::normalize(glm::vec3(-0.45f, -1.0f, -0.35f));
  light.color = glm::vec3(1.0f, 0.96f, 0.9f);
  light.intensity = 4;
  return light;
}

int chooseVariant(const std::vector<std::string>& names, const std::string& wanted, const Diagnostics& diagnostics) {
  if (wanted.empty()) return -1;
  const auto named = std::find(names.begin(), names.end(), wanted);
  if (named != names.end()) return static_cast<int>(named - names.begin());
  std::string known;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (wanted == std::to_string(i)) return static_cast<int>(i);
    known += (i ? ", " : "") + std::to_string(i) + " '" + names[i].substr(0, 100) + "'";
  }
  throw Error(ErrorKind::usage, diagnostics.file + ": unknown variant '" + wanted + "'; " +
                                    (known.empty() ? "the scene has none" : "known are " + known));
}

class Builder {
 public:
  Builder(const Document& document, const GltfOptions& options, Diagnostics& diagnostics)
      : document_(document),
        diagnostics_(diagnostics),
        variant_(chooseVariant(document.variants, options.variant, diagnostics)),
        hierarchy_(buildHierarchy(document, diagnostics)) {}

  Model run() {
    model_.scene.name = document_.sceneName;
    buildMaterials(document_, diagnostics_, model_.scene);
    model_.rig.nodes = hierarchy_.nodes;
    buildSkins(document_, diagnostics_, hierarchy_, model_.rig);
    buildAnimations(document_, diagnostics_, hierarchy_, model_.rig);
    readMeshes();
    rest_ = evaluate(model_.rig, {});
    moving_ = movingNodes(model_.rig);
    checkCounts();
    measure();
    flatten();
    addViews();
    model_.variants = document_.variants;
    model_.warnings = std::move(diagnostics_.warnings);
    return std::move(model_);
  }

 private:
  // Only meshes that the scene shows are read, each once for all its nodes.
  void readMeshes() {
    std::optional<std::uint32_t> defaultMaterial;
    meshes_.resize(document_.meshes.size());
    std::size_t points = 0, lines = 0, primitivesLeftOut = 0;
    for (std::size_t n = 0; n < hierarchy_.inScene; ++n) {
      const int mesh = meshOf(n);
      if (mesh < 0 || !meshes_[static_cast<std::size_t>(mesh)].empty()) continue;
      const auto& primitives = document_.meshes[static_cast<std::size_t>(mesh)].primitives;
      for (std::size_t p = 0; p < primitives.size(); ++p) {
        const Geometry& read = meshes_[static_cast<std::size_t>(mesh)].emplace_back(readPrimitive(
            document_, diagnostics_, mesh, static_cast<int>(p), variant_, model_.scene.materials, defaultMaterial));
        points += read.points;
        lines += read.lines;
        primitivesLeftOut += read.points + read.lines > 0;
      }
    }
    if (primitivesLeftOut > 0)
      diagnostics_.warn("points and lines are left out, only triangles are drawn: " + std::to_string(points) +
                        " points and " + std::to_string(lines) + " lines in " + std::to_string(primitivesLeftOut) +
                        " primitives");
  }

  int meshOf(std::size_t node) const { return fileNode(node).mesh; }
  const Node& fileNode(std::size_t node) const {
    return document_.nodes[static_cast<std::size_t>(hierarchy_.fileNode[node])];
  }

  // Calls with each primitive of the scene, its shape set for the node that places it.
  void forEachPlaced(const std::function<void(Geometry&)>& visit) {
    for (std::size_t n = 0; n < hierarchy_.inScene; ++n) {
      if (meshOf(n) < 0) continue;
      for (Geometry& geometry : meshes_[static_cast<std::size_t>(meshOf(n))]) {
        if (geometry.triangles.empty()) continue;
        geometry.shape.node = static_cast<int>(n);
        geometry.shape.skin = skinOf(n, geometry);
        visit(geometry);
      }
    }
  }

  int skinOf(std::size_t node, const Geometry& geometry) {
    const int skin = fileNode(node).skin;
    if (skin == -1) return -1;
    const std::string where = item("nodes", static_cast<std::size_t>(hierarchy_.fileNode[node]));
    const Skin& source = get(document_.skins, skin, "skins", diagnostics_, where);
    if (geometry.shape.joints.empty()) {
      diagnostics_.warn("a mesh without joints and weights is not skinned: " + where);
      return -1;
    }
    if (geometry.largestJoint >= source.joints.size())
      diagnostics_.fail("has the joint " + std::to_string(geometry.largestJoint) + " for " +
                            std::to_string(source.joints.size()) + " joints",
                        where);
    return skin;
  }

  // Checked before anything is allocated for them.
  void checkCounts() {
    std::size_t vertices = 0, triangles = 0;
    forEachPlaced([&](const Geometry& geometry) {
      vertices += geometry.shape.rest.size();
      triangles += geometry.triangles.size();
      if (vertices > kMaxVertices || triangles > kMaxTriangles)
        diagnostics_.fail("has more than " + std::to_string(kMaxTriangles) + " triangles or vertices",
                          "its nodes' meshes together");
    });
    if (triangles == 0) diagnostics_.fail("has no triangles", document_.nodes.empty() ? "it has no nodes" : "scene");
  }

  // Bounds of what the triangles use, and with them the origin.
  void measure() {
    WorldBounds bounds;
    forEachPlaced([&](const Geometry& geometry) {
      const auto positions = worldPositions(model_.rig, geometry.shape, rest_);
      for (const auto& triangle : geometry.triangles)
        for (const std::uint32_t index : triangle) {
          if (!geometry.finite[index]) continue;
          const glm::dvec3& p = positions[index];
          if (!(glm::abs(p.x) <= kLargestCoordinate && glm::abs(p.y) <= kLargestCoordinate &&
                glm::abs(p.z) <= kLargestCoordinate))
            diagnostics_.fail("has coordinates beyond 1e30", nodeOf(geometry));
          bounds.add(p);
        }
    });
    const glm::dvec3 extent = bounds.high - bounds.low;
    if (const double largest = std::max({extent.x, extent.y, extent.z}); largest > kLargestExtent) {
      std::ostringstream text;
      text << "is " << largest << " m across; at most " << kLargestExtent << " m can be drawn";
      diagnostics_.fail(text.str(), "scene");
    }
    if (bounds.low.x <= bounds.high.x) model_.scene.origin = chooseOrigin(bounds);
  }

  std::string nodeOf(const Geometry& geometry) const {
    return item("nodes", static_cast<std::size_t>(hierarchy_.fileNode[static_cast<std::size_t>(geometry.shape.node)]));
  }

  void flatten() {
    Scene& scene = model_.scene;
    forEachPlaced([&](Geometry& geometry) {
      Instance& shape = geometry.shape;
      shape.firstVertex = static_cast<std::uint32_t>(scene.vertices.size());
      shape.vertexCount = static_cast<std::uint32_t>(shape.rest.size());
      scene.vertices.resize(scene.vertices.size() + shape.rest.size());
      shape.turned = mirrored(model_.rig, shape, rest_);
      place(model_.rig, shape, rest_, scene.origin, std::span(scene.vertices).subspan(shape.firstVertex));
      shape.firstTriangle = static_cast<std::uint32_t>(scene.triangles.size());
      const bool rigid = shape.skin < 0 && shape.targets.empty();
      const bool moves = canMove(model_.rig, moving_, shape);
      for (const auto& source : geometry.triangles) {
        Triangle triangle;
        triangle.material = geometry.material;
        for (std::size_t k = 0; k < 3; ++k) triangle.vertices[k] = shape.firstVertex + source[k];
        if (shape.turned) std::swap(triangle.vertices[1], triangle.vertices[2]);
        const bool finite = geometry.finite[source[0]] && geometry.finite[source[1]] && geometry.finite[source[2]];
        keep(triangle, finite, !rigid || hasArea(shape, source), moves);
      }
      shape.triangleCount = static_cast<std::uint32_t>(scene.triangles.size()) - shape.firstTriangle;
      addPart(geometry);
      if (moves) model_.rig.instances.push_back(shape);
    });
    if (scene.triangles.empty())
      diagnostics_.fail("has no triangles left", std::to_string(model_.dropped.degenerate) + " are degenerate, " +
                                                     std::to_string(model_.dropped.nonFinite) + " are not finite");
    // Unused vertices must not contain values that a reader of the buffer would choke on.
    for (Vertex& vertex : scene.vertices)
      if (glm::any(glm::isnan(vertex.position)) || glm::any(glm::isinf(vertex.position)))
        vertex.position = glm::vec3(0);
  }

  // What moves may be degenerate at rest: a later pose shows it, unless its own shape has no area.
  void keep(const Triangle& triangle, bool finite, bool hasArea, bool moves) {
    const auto corner = [&](std::size_t k) { return model_.scene.vertices[triangle.vertices[k]].position; };
    if (!finite)
      ++model_.dropped.nonFinite;
    else if (!hasArea || !(moves || hasNormal(corner(0), corner(1), corner(2))))
      ++model_.dropped.degenerate;
    else
      model_.scene.triangles.push_back(triangle);
  }

  void addPart(const Geometry& geometry) {
    const Instance& shape = geometry.shape;
    const std::string& mesh = document_.meshes[static_cast<std::size_t>(shape.mesh)].name;
    Part part;
    part.node = nodeName(document_, hierarchy_.fileNode[static_cast<std::size_t>(shape.node)]);
    part.mesh = mesh.empty() ? "mesh " + std::to_string(shape.mesh) : mesh;
    part.primitive = shape.primitive;
    part.firstTriangle = shape.firstTriangle;
    part.triangleCount = shape.triangleCount;
    part.material = geometry.material;
    model_.parts.push_back(std::move(part));
  }

  void addViews() {
    Scene& scene = model_.scene;
    buildLights(document_, diagnostics_, hierarchy_, model_);
    buildCameras(document_, diagnostics_, hierarchy_, model_);
    const Bounds bounds = scene.bounds();
    for (std::size_t i = 0; i < scene.lights.size(); ++i)
      follow(scene.lights[i], worldOf(model_.rig.lightNodes[i]), scene.origin);
    for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
      scene.cameras[i].eye = glm::vec3(0);
      scene.cameras[i].target = glm::vec3(0, 0, bounds.diagonal() > 0 ? -0.5f * bounds.diagonal() : -1.0f);
      follow(scene.cameras[i], worldOf(model_.rig.cameraNodes[i]), scene.origin);
    }
    if (scene.lights.empty()) {
      scene.lights.push_back(sun());
      model_.rig.lightNodes.push_back(-1);
      diagnostics_.warn("the scene has no lights: it is lit by a default sun and sky");
    }
    if (scene.cameras.empty()) {
      // What is a point or nothing at rest is framed as its animations make it.
      scene.cameras.push_back(frameAll(bounds.diagonal() > 0 ? bounds : animatedBounds(model_).all));
      model_.rig.cameraNodes.push_back(-1);
      diagnostics_.warn("the scene has no camera: the view shows the whole scene");
    }
  }

  const glm::dmat4& worldOf(int node) const { return rest_.world[static_cast<std::size_t>(node)]; }

  const Document& document_;
  Diagnostics& diagnostics_;
  const int variant_;  // into the document's, -1: none
  const Hierarchy hierarchy_;
  Model model_;
  PoseState rest_;
  std::vector<std::uint8_t> moving_;
  std::vector<std::vector<Geometry>> meshes_;  // for each mesh of the file, its primitives
};

}  // namespace

Model build(const Document& document, const GltfOptions& options, Diagnostics& diagnostics) {
  return Builder(document, options, diagnostics).run();
}

}  // namespace halfsilver::gltf
