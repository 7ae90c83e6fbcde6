#include "io/gltf_meshes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "io/gltf_accessors.h"
#include "scene/tangents.h"

namespace halfsilver::gltf {
namespace {

using Corners = std::array<std::uint32_t, 3>;

constexpr int kTriangles = 4, kFan = 6;  // between them strips

template <class Vector>
Vector element(const Floats& floats, std::size_t index, Vector value = Vector(0)) {
  const auto components = static_cast<std::size_t>(floats.components);
  for (std::size_t c = 0; c < std::min(components, static_cast<std::size_t>(Vector::length())); ++c)
    value[static_cast<int>(c)] = floats.values[index * components + c];
  return value;
}

template <class Vector>
bool isFinite(const Vector& v) {
  for (int c = 0; c < Vector::length(); ++c)
    if (!std::isfinite(v[c])) return false;
  return true;
}

// Length 1 up to rounding, whatever the scale; zero if there is no direction.
glm::vec3 unit(const glm::vec3& v) {
  const glm::dvec3 exact(v);
  const double length = glm::length(exact);
  return isFinite(v) && length > 0 ? glm::vec3(exact / length) : glm::vec3(0);
}

class Reader {
 public:
  Reader(const Document& document, Diagnostics& diagnostics, const Primitive& source, std::string where,
         Geometry& geometry)
      : document_(document),
        diagnostics_(diagnostics),
        source_(source),
        where_(std::move(where)),
        geometry_(geometry),
        vertices_(geometry.shape.rest) {}

  void read(const Material& material) {
    readPositions();
    readTriangles();
    const bool hasNormals = readNormals();
    const bool hasTangents = hasNormals && readTangents();
    for (std::size_t set = 0; set < 2; ++set) readUv(set);
    readColors();
    readSkin();
    readTargets();
    if (!hasNormals) makeNormals();
    if (hasTangents) return;
    // Directions on the surface are those of the normal map, and of the anisotropy where there is none.
    const TextureUse& mapped = material.normalTexture.texture >= 0       ? material.normalTexture
                               : material.coatNormalTexture.texture >= 0 ? material.coatNormalTexture
                                                                         : material.anisotropyTexture;
    if (mapped.texture >= 0 || material.anisotropy > 0) {
      const auto set = static_cast<std::size_t>(mapped.uvSet);
      follow(makeTangents(vertices_, geometry_.triangles, set, mapped.transform));
    } else {
      for (Vertex& vertex : vertices_) vertex.tangent = glm::vec4(anyPerpendicular(vertex.normal), 1);
    }
  }

 private:
  int accessor(const std::string& attribute) const {
    const auto found = source_.attributes.find(attribute);
    return found == source_.attributes.end() ? -1 : found->second;
  }

  Floats floats(const std::string& attribute, int accessor, int minComponents, int maxComponents) {
    const std::string where = where_ + "." + attribute;
    Floats result = readFloats(document_, diagnostics_, accessor, minComponents, maxComponents, where);
    if (!vertices_.empty() && result.count() != vertices_.size())
      diagnostics_.fail(
          "has " + std::to_string(result.count()) + " elements for " + std::to_string(vertices_.size()) + " vertices",
          where);
    return result;
  }

  void readPositions() {
    if (accessor("POSITION") < 0) diagnostics_.fail("has no POSITION", where_);
    const Floats positions = floats("POSITION", accessor("POSITION"), 3, 3);
    if (positions.count() > std::numeric_limits<std::uint32_t>::max())
      diagnostics_.fail("has too many vertices", where_);
    vertices_.resize(positions.count());
    geometry_.finite.resize(positions.count(), 1);
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      const auto position = element<glm::vec3>(positions, i);
      if (isFinite(position))
        vertices_[i].position = position;
      else
        geometry_.finite[i] = 0;
    }
  }

  void readTriangles() {
    std::vector<std::uint32_t> indices;
    if (source_.indices >= 0) {
      indices = readUnsigned(document_, diagnostics_, source_.indices, 1, where_ + ".indices");
    } else {
      indices.resize(vertices_.size());
      for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = static_cast<std::uint32_t>(i);
    }
    for (const std::uint32_t index : indices)
      if (index >= vertices_.size())
        diagnostics_.fail(
            "has the index " + std::to_string(index) + " for " + std::to_string(vertices_.size()) + " vertices",
            where_ + ".indices");
    if (source_.mode == kTriangles && indices.size() % 3 != 0)
      diagnostics_.warn("indices that do not make a whole triangle were ignored: " + where_);
    auto& triangles = geometry_.triangles;
    if (source_.mode == kTriangles) {
      for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
        triangles.push_back({indices[i], indices[i + 1], indices[i + 2]});
      return;
    }
    for (std::size_t i = 0; i + 2 < indices.size(); ++i) {
      if (source_.mode == kFan)
        triangles.push_back({indices[i + 1], indices[i + 2], indices[0]});
      else  // every other triangle of a strip winds the other way
        triangles.push_back({indices[i], indices[i + 1 + i % 2], indices[i + 2 - i % 2]});
    }
  }

  bool readNormals() {
    if (accessor("NORMAL") < 0) return false;
    const Floats normals = floats("NORMAL", accessor("NORMAL"), 3, 3);
    std::vector<std::uint8_t> missing(vertices_.size(), 0);
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      vertices_[i].normal = unit(element<glm::vec3>(normals, i));
      missing[i] = vertices_[i].normal == glm::vec3(0);
    }
    if (std::find(missing.begin(), missing.end(), 1) != missing.end()) repairNormals(missing);
    return true;
  }

  // Vertices whose normal has no direction take the normal of one of their triangles.
  void repairNormals(const std::vector<std::uint8_t>& missing) {
    bool used = false;
    for (const Corners& triangle : geometry_.triangles)
      for (const std::uint32_t index : triangle)
        if (missing[index]) {
          used = true;
          vertices_[index].normal = faceNormal(triangle);
        }
    for (Vertex& vertex : vertices_)
      if (vertex.normal == glm::vec3(0)) vertex.normal = glm::vec3(0, 1, 0);
    if (used) diagnostics_.warn("normals without a direction were replaced: " + where_);
  }

  glm::vec3 faceNormal(const Corners& triangle) const {
    std::array<glm::dvec3, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = vertices_[triangle[k]].position;
    const glm::dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
    const double length = glm::length(normal);
    return length > 0 && std::isfinite(length) ? glm::vec3(normal / length) : glm::vec3(0, 1, 0);
  }

  bool readTangents() {
    if (accessor("TANGENT") < 0) return false;
    const Floats tangents = floats("TANGENT", accessor("TANGENT"), 4, 4);
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      const auto tangent = element<glm::vec4>(tangents, i);
      const glm::vec3 direction = unit(glm::vec3(tangent));
      vertices_[i].tangent = glm::vec4(direction == glm::vec3(0) ? anyPerpendicular(vertices_[i].normal) : direction,
                                       tangent.w < 0 ? -1.0f : 1.0f);
    }
    return true;
  }

  void readUv(std::size_t set) {
    const std::string name = "TEXCOORD_" + std::to_string(set);
    if (accessor(name) < 0) return;
    const Floats uv = floats(name, accessor(name), 2, 2);
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      const auto value = element<glm::vec2>(uv, i);
      if (isFinite(value))
        vertices_[i].uv[set] = value;
      else
        diagnostics_.warn("texture coordinates that are not finite were set to zero: " + where_);
    }
  }

  void readColors() {
    if (accessor("COLOR_0") < 0) return;
    const Floats colors = floats("COLOR_0", accessor("COLOR_0"), 3, 4);
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      const auto color = element(colors, i, glm::vec4(1));
      if (isFinite(color))
        vertices_[i].color = glm::clamp(color, 0.0f, 1.0f);
      else
        diagnostics_.warn("vertex colors that are not finite were set to white: " + where_);
    }
  }

  void readSkin() {
    if (accessor("JOINTS_0") < 0 || accessor("WEIGHTS_0") < 0) return;
    const auto name = [](const char* attribute, std::size_t set) { return attribute + std::to_string(set); };
    std::size_t sets = 1;
    while (accessor(name("JOINTS_", sets)) >= 0 && accessor(name("WEIGHTS_", sets)) >= 0) ++sets;
    Instance& shape = geometry_.shape;
    shape.jointSets = static_cast<std::uint32_t>(sets);
    shape.joints.assign(sets * vertices_.size(), glm::uvec4(0));
    shape.weights.assign(sets * vertices_.size(), glm::vec4(0));
    for (std::size_t set = 0; set < sets; ++set) readInfluences(name("JOINTS_", set), name("WEIGHTS_", set), set);
    for (std::size_t first = 0; first < shape.weights.size(); first += sets) {
      const std::span<glm::vec4> weights(shape.weights.data() + first, sets);
      double sum = 0;
      for (const glm::vec4& weight : weights) sum += glm::dot(glm::dvec4(weight), glm::dvec4(1));
      for (glm::vec4& weight : weights) weight = sum > 0 ? glm::vec4(glm::dvec4(weight) / sum) : glm::vec4(0);
      if (!(sum > 0)) weights.front().x = 1;
    }
  }

  void readInfluences(const std::string& jointName, const std::string& weightName, std::size_t set) {
    const std::string where = where_ + "." + jointName;
    const auto joints = readUnsigned(document_, diagnostics_, accessor(jointName), 4, where);
    if (joints.size() != 4 * vertices_.size()) diagnostics_.fail("does not have four joints per vertex", where);
    const Floats weights = floats(weightName, accessor(weightName), 4, 4);
    Instance& shape = geometry_.shape;
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      const auto weight = element<glm::vec4>(weights, i);
      for (int k = 0; k < 4; ++k) {
        if (!std::isfinite(weight[k]) || weight[k] <= 0) continue;
        // The joint of an unused slot is often leftover data.
        const std::uint32_t joint = joints[4 * i + static_cast<std::size_t>(k)];
        shape.joints[i * shape.jointSets + set][k] = joint;
        shape.weights[i * shape.jointSets + set][k] = weight[k];
        geometry_.largestJoint = std::max(geometry_.largestJoint, joint);
      }
    }
  }

  void readTargets() {
    diagnostics_.require(source_.targets.size() * vertices_.size() * 3, where_ + ".targets");
    for (std::size_t t = 0; t < source_.targets.size(); ++t) {
      Instance::MorphTarget target;
      for (const auto& [name, index] : source_.targets[t]) {
        std::vector<glm::vec3>* deltas = nullptr;
        if (name == "POSITION") deltas = &target.positions;
        if (name == "NORMAL") deltas = &target.normals;
        if (name == "TANGENT") deltas = &target.tangents;
        if (!deltas) {
          diagnostics_.warn("morph targets of " + name.substr(0, 40) + " are ignored: " + where_);
          continue;
        }
        const Floats values = floats(item("targets", t) + "." + name, index, 3, 3);
        for (std::size_t i = 0; i < values.count(); ++i) {
          const auto delta = element<glm::vec3>(values, i);
          if (!isFinite(delta))
            diagnostics_.warn("morph target values that are not finite were set to zero: " + where_);
          deltas->push_back(isFinite(delta) ? delta : glm::vec3(0));
        }
      }
      geometry_.shape.targets.push_back(std::move(target));
    }
  }

  // Flat shading, as glTF requires: each triangle gets its own vertices.
  void makeNormals() {
    std::vector<std::uint32_t> origins;
    for (const Corners& triangle : geometry_.triangles) origins.insert(origins.end(), triangle.begin(), triangle.end());
    diagnostics_.spend(origins.size() * 12, where_);
    std::vector<Vertex> unshared;
    for (const Corners& triangle : geometry_.triangles)
      for (const std::uint32_t index : triangle) {
        unshared.push_back(vertices_[index]);
        unshared.back().normal = faceNormal(triangle);
      }
    const auto gather = [&](auto& list, std::size_t perVertex) {
      if (list.empty()) return;
      std::remove_reference_t<decltype(list)> gathered;
      for (const std::uint32_t index : origins)
        for (std::size_t i = 0; i < perVertex; ++i) gathered.push_back(list[index * perVertex + i]);
      list = std::move(gathered);
    };
    forEachList(gather);
    vertices_ = std::move(unshared);
    for (std::size_t i = 0; i < geometry_.triangles.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) geometry_.triangles[i][k] = static_cast<std::uint32_t>(3 * i + k);
    geometry_.shape.flatNormals = true;
  }

  // Extends the per-vertex data to vertices copied at the end.
  void follow(const std::vector<std::uint32_t>& copied) {
    forEachList([&](auto& list, std::size_t perVertex) {
      if (list.empty()) return;
      for (const std::uint32_t index : copied)
        for (std::size_t i = 0; i < perVertex; ++i) {
          auto value = list[index * perVertex + i];
          list.push_back(value);
        }
    });
  }

  // The data that accompanies each vertex.
  template <class Change>
  void forEachList(const Change& change) {
    change(geometry_.finite, 1);
    change(geometry_.shape.joints, geometry_.shape.jointSets);
    change(geometry_.shape.weights, geometry_.shape.jointSets);
    for (auto& target : geometry_.shape.targets) {
      change(target.positions, 1);
      change(target.normals, 1);
      change(target.tangents, 1);
    }
  }

  const Document& document_;
  Diagnostics& diagnostics_;
  const Primitive& source_;
  const std::string where_;
  Geometry& geometry_;
  std::vector<Vertex>& vertices_;
};

// How many points or lines a primitive is.
void countLeftOut(const Document& document, const Diagnostics& diagnostics, const Primitive& source,
                  const std::string& where, Geometry& geometry) {
  constexpr int kPoints = 0, kLines = 1, kLoop = 2;
  const auto position = source.attributes.find("POSITION");
  const int accessor = source.indices >= 0                   ? source.indices
                       : position == source.attributes.end() ? -1
                                                             : position->second;
  if (accessor < 0) diagnostics.fail("has no POSITION", where);
  const std::size_t count = get(document.accessors, accessor, "accessors", diagnostics, where).count;
  if (source.mode == kPoints)
    geometry.points = count;
  else
    geometry.lines = source.mode == kLines  ? count / 2
                     : source.mode == kLoop ? count
                                            : count - std::min<std::size_t>(count, 1);
}

}  // namespace

Geometry readPrimitive(const Document& document, Diagnostics& diagnostics, int mesh, int primitive, int variant,
                       std::vector<Material>& materials, std::optional<std::uint32_t>& defaultMaterial) {
  const Primitive& source =
      document.meshes[static_cast<std::size_t>(mesh)].primitives[static_cast<std::size_t>(primitive)];
  const std::string where =
      item("meshes", static_cast<std::size_t>(mesh)) + "." + item("primitives", static_cast<std::size_t>(primitive));
  Geometry geometry;
  geometry.shape.mesh = mesh;
  geometry.shape.primitive = primitive;
  if (source.mode < 0 || source.mode > kFan)
    diagnostics.fail("has the unknown mode " + std::to_string(source.mode), where);
  if (source.mode < kTriangles) {
    countLeftOut(document, diagnostics, source, where, geometry);
    return geometry;
  }
  const auto chosen = source.variants.find(variant);
  if (const int material = chosen == source.variants.end() ? source.material : chosen->second; material >= 0) {
    get(document.materials, material, "materials", diagnostics, where);
    geometry.material = static_cast<std::uint32_t>(material);
  } else {
    if (!defaultMaterial) {
      defaultMaterial = static_cast<std::uint32_t>(materials.size());
      materials.emplace_back().name = "default";
    }
    geometry.material = *defaultMaterial;
  }
  Reader(document, diagnostics, source, where, geometry).read(materials[geometry.material]);
  return geometry;
}

}  // namespace halfsilver::gltf
