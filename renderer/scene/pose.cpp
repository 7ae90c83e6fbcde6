#include "scene/pose.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <set>
#include <string>
#include <utility>

#include <halfsilver/error.h>
#include "scene/tangents.h"

namespace halfsilver {
namespace {

static_assert(sizeof(Vertex) == 18 * sizeof(float), "vertices are compared as bytes");

// Value of a channel at a time, which is clamped to the first and last key.
std::vector<double> sample(const Channel& channel, float time) {
  const bool cubic = channel.interpolation == Interpolation::cubicSpline;
  const std::size_t keys = channel.times.size();
  const std::size_t width = keys ? channel.values.size() / (keys * (cubic ? 3 : 1)) : 0;
  std::vector<double> result(width);
  if (!width) return result;
  // part 0: in-tangent, 1: value, 2: out-tangent; without tangents the value is part 0.
  const auto at = [&](std::size_t key, std::size_t part, std::size_t component) {
    return static_cast<double>(channel.values[(cubic ? key * 3 + part : key) * width + component]);
  };
  const auto upper = std::upper_bound(channel.times.begin(), channel.times.end(), time);
  const auto next = static_cast<std::size_t>(upper - channel.times.begin());
  if (next == 0 || next == keys || channel.interpolation == Interpolation::step) {
    const std::size_t key = next == 0 ? 0 : next - 1;
    for (std::size_t c = 0; c < width; ++c) result[c] = at(key, 1, c);
    return result;
  }
  const std::size_t key = next - 1;
  const double span = static_cast<double>(channel.times[next]) - static_cast<double>(channel.times[key]);
  const double t = (static_cast<double>(time) - static_cast<double>(channel.times[key])) / span;
  if (cubic) {
    const double t2 = t * t, t3 = t2 * t;
    for (std::size_t c = 0; c < width; ++c)
      result[c] = (2 * t3 - 3 * t2 + 1) * at(key, 1, c) + span * (t3 - 2 * t2 + t) * at(key, 2, c) +
                  (3 * t2 - 2 * t3) * at(next, 1, c) + span * (t3 - t2) * at(next, 0, c);
  } else if (channel.property == AnimatedProperty::rotation && width == 4) {
    const auto quaternion = [&](std::size_t k) {
      return glm::normalize(glm::dquat(at(k, 1, 3), at(k, 1, 0), at(k, 1, 1), at(k, 1, 2)));
    };
    const glm::dquat q = glm::slerp(quaternion(key), quaternion(next), t);
    result = {q.x, q.y, q.z, q.w};
  } else {
    for (std::size_t c = 0; c < width; ++c) result[c] = (1 - t) * at(key, 1, c) + t * at(next, 1, c);
  }
  return result;
}

glm::dmat4 localMatrix(const Node& node) {
  if (node.hasMatrix) return node.matrix;
  glm::dmat4 matrix = glm::mat4_cast(node.rotation);
  for (int axis = 0; axis < 3; ++axis) matrix[axis] *= node.scale[axis];
  matrix[3] = glm::dvec4(node.translation, 1);
  return matrix;
}

void apply(const Channel& channel, float time, Node& node, std::vector<double>& weights) {
  const std::vector<double> value = sample(channel, time);
  switch (channel.property) {
    case AnimatedProperty::translation:
      if (value.size() == 3) node.translation = {value[0], value[1], value[2]};
      break;
    case AnimatedProperty::scale:
      if (value.size() == 3) node.scale = {value[0], value[1], value[2]};
      break;
    case AnimatedProperty::rotation:
      if (value.size() == 4) {
        const glm::dquat q(value[3], value[0], value[1], value[2]);
        const double length = glm::length(q);
        if (length > 0) node.rotation = q / length;
      }
      break;
    case AnimatedProperty::weights:
      weights = value;
      break;
  }
}

const Skin* skinOf(const Rig& rig, const Instance& instance) {
  if (instance.skin < 0) return nullptr;
  const Skin& skin = rig.skins[static_cast<std::size_t>(instance.skin)];
  return skin.joints.empty() ? nullptr : &skin;
}

// The transform of one vertex from its rest pose to the world.
struct Placer {
  const Instance& instance;
  const std::vector<double>& weights;
  std::vector<glm::dmat4> matrices;
  bool skinned;

  Placer(const Rig& rig, const Instance& placed, const PoseState& state)
      : instance(placed),
        weights(state.weights[static_cast<std::size_t>(placed.node)]),
        matrices(placingMatrices(rig, placed, state)),
        skinned(skinOf(rig, placed) != nullptr) {}

  glm::dmat4 matrix(std::size_t vertex) const {
    if (!skinned) return matrices.front();
    glm::dmat4 sum(0);
    double total = 0;  // 1 up to the rounding of floats, which far from the origin is a visible distance
    const std::size_t sets = instance.jointSets;
    for (std::size_t set = vertex * sets; set < (vertex + 1) * sets; ++set)
      for (int k = 0; k < 4; ++k) {
        const double weight = instance.weights[set][k];
        if (weight == 0) continue;
        sum += weight * matrices[instance.joints[set][k]];
        total += weight;
      }
    return total > 0 ? sum / total : sum;
  }

  glm::dvec3 morphed(glm::dvec3 value, std::size_t vertex,
                     std::vector<glm::vec3> Instance::MorphTarget::*attribute) const {
    for (std::size_t k = 0; k < std::min(weights.size(), instance.targets.size()); ++k)
      if (const auto& deltas = instance.targets[k].*attribute; !deltas.empty() && weights[k] != 0)
        value += weights[k] * glm::dvec3(deltas[vertex]);
    return value;
  }

  glm::dvec3 position(std::size_t vertex, const glm::dmat4& toWorld) const {
    return toWorld * glm::dvec4(morphed(instance.rest[vertex].position, vertex, &Instance::MorphTarget::positions), 1);
  }
};

// Transforms normals: the inverse transpose times the absolute determinant, without dividing by it, so that matrices
// that flatten an object work too.
glm::dmat3 normalMatrix(const glm::dmat3& m, double sign) {
  return glm::dmat3(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])) * sign;
}

// Unit length, or the fallback if the vector is zero or not finite. Scaled first, as squares of tiny values underflow.
glm::dvec3 unit(const glm::dvec3& v, const glm::dvec3& fallback) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!(largest > 0) || !std::isfinite(largest)) return fallback;
  return glm::normalize(v / largest);
}

double signOf(double determinant) { return determinant < 0 ? -1.0 : 1.0; }

// The shortest decimal that reads back as the float: 0.4, not 0.4000000059604645.
double decimalOf(float value) {
  char text[32];
  const char* const end = std::to_chars(text, text + sizeof(text), value).ptr;
  double decimal = 0;
  std::from_chars(text, end, decimal);
  return decimal;
}

// What the float stands for: the fraction with the smallest denominator that rounds to it, as frames make them (16/15
// for 1.0666667), or else its decimal. Up to some eight minutes only one such fraction rounds to a float.
double exactDuration(float value) {
  constexpr int kLargestDenominator = 240;
  for (int denominator = 1; denominator <= kLargestDenominator; ++denominator) {
    const double fraction = std::round(static_cast<double>(value) * denominator) / denominator;
    if (static_cast<float>(fraction) == value) return fraction;
  }
  return decimalOf(value);
}

// Rounded to the float that a key of the same time is, so that a key holds from its own time on, in every loop. A loop
// ends with the last pose: at each multiple of its duration, but for 0.
float timeInLoop(double seconds, float duration) {
  const double length = exactDuration(duration);
  if (!(length > 0)) return 0;
  for (const double end : {length, decimalOf(duration)}) {
    // Multiples are a rounding error beside it.
    const double loops = seconds / end, whole = std::round(loops);
    if (whole >= 1 && std::abs(loops - whole) <= 1e-12 * whole) return duration;
  }
  return std::min(duration, static_cast<float>(seconds - length * std::floor(seconds / length)));
}

float timeOf(const Playing& playing, float duration) {
  if (playing.loop) return timeInLoop(playing.seconds, duration);
  return std::clamp(static_cast<float>(playing.seconds), 0.0f, duration);
}

// Makes the triangles of the instance wind as its pose asks for. Returns whether they did not.
bool turn(Scene& scene, Instance& instance, bool turned) {
  if (instance.turned == turned) return false;
  instance.turned = turned;
  for (std::uint32_t t = instance.firstTriangle; t < instance.firstTriangle + instance.triangleCount; ++t)
    std::swap(scene.triangles[t].vertices[1], scene.triangles[t].vertices[2]);
  return true;
}

}  // namespace

PoseState evaluate(const Rig& rig, std::span<const Playing> playing) {
  std::vector<Node> nodes = rig.nodes;
  PoseState state;
  for (const Node& node : nodes) state.weights.emplace_back(node.weights.begin(), node.weights.end());
  for (const Playing& played : playing) {
    if (!std::isfinite(played.seconds)) throw Error(ErrorKind::usage, "the time of an animation must be finite");
    if (played.animation < 0 || static_cast<std::size_t>(played.animation) >= rig.animations.size())
      throw Error(ErrorKind::usage, "there is no animation " + std::to_string(played.animation) + "; the scene has " +
                                        std::to_string(rig.animations.size()));
    const Animation& animation = rig.animations[static_cast<std::size_t>(played.animation)];
    const float time = timeOf(played, animation.duration);
    for (const Channel& channel : animation.channels) {
      const auto node = static_cast<std::size_t>(channel.node);
      apply(channel, time, nodes[node], state.weights[node]);
    }
  }
  for (const Node& node : nodes) {
    const glm::dmat4 local = localMatrix(node);
    state.world.push_back(node.parent < 0 ? local : state.world[static_cast<std::size_t>(node.parent)] * local);
  }
  return state;
}

std::vector<Playing> playTogether(std::span<const int> animations, double seconds, bool loop) {
  std::vector<Playing> playing;
  for (const int animation : animations) playing.push_back({animation, seconds, loop});
  return playing;
}

std::vector<int> compatibleAnimations(const Rig& rig) {
  std::vector<int> compatible;
  std::set<std::pair<int, AnimatedProperty>> taken;
  for (std::size_t a = 0; a < rig.animations.size(); ++a) {
    const std::vector<Channel>& channels = rig.animations[a].channels;
    const bool conflicts = std::any_of(channels.begin(), channels.end(), [&](const Channel& channel) {
      return taken.count({channel.node, channel.property}) != 0;
    });
    if (conflicts) continue;
    compatible.push_back(static_cast<int>(a));
    for (const Channel& channel : channels) taken.insert({channel.node, channel.property});
  }
  return compatible;
}

std::vector<glm::dmat4> placingMatrices(const Rig& rig, const Instance& instance, const PoseState& state) {
  const Skin* const skin = skinOf(rig, instance);
  if (!skin) return {state.world[static_cast<std::size_t>(instance.node)]};
  std::vector<glm::dmat4> matrices;
  for (std::size_t j = 0; j < skin->joints.size(); ++j)
    matrices.push_back(state.world[static_cast<std::size_t>(skin->joints[j])] * skin->inverseBind[j]);
  return matrices;
}

std::vector<double> matrixShares(const Rig& rig, const Instance& instance) {
  const Skin* const skin = skinOf(rig, instance);
  if (!skin) return {1};
  std::vector<double> shares(skin->joints.size());
  for (std::size_t i = 0; i < instance.joints.size(); ++i)
    for (int k = 0; k < 4; ++k) shares[instance.joints[i][k]] += static_cast<double>(instance.weights[i][k]);
  return shares;
}

bool mirrored(std::span<const glm::dmat4> matrices, std::span<const double> shares) {
  double turned = 0;
  for (std::size_t j = 0; j < matrices.size(); ++j) {
    const double determinant = glm::determinant(glm::dmat3(matrices[j]));
    turned += shares[j] * (determinant < 0 ? 1 : determinant > 0 ? -1 : 0);
  }
  return turned > 0;
}

bool mirrored(const Rig& rig, const Instance& instance, const PoseState& state) {
  const std::vector<glm::dmat4> matrices = placingMatrices(rig, instance, state);
  const auto upright = [](const glm::dmat4& matrix) { return glm::determinant(glm::dmat3(matrix)) > 0; };
  if (std::all_of(matrices.begin(), matrices.end(), upright)) return false;  // whatever their shares
  return mirrored(matrices, matrixShares(rig, instance));
}

std::vector<glm::dvec3> worldPositions(const Rig& rig, const Instance& instance, const PoseState& state) {
  const Placer placer(rig, instance, state);
  std::vector<glm::dvec3> positions;
  positions.reserve(instance.rest.size());
  for (std::size_t i = 0; i < instance.rest.size(); ++i) positions.push_back(placer.position(i, placer.matrix(i)));
  return positions;
}

void place(const Rig& rig, const Instance& instance, const PoseState& state, const glm::dvec3& origin,
           std::span<Vertex> vertices) {
  const Placer placer(rig, instance, state);
  const double flip = instance.turned ? -1 : 1;
  std::array<glm::dvec3, 3> corners;
  glm::dvec3 flat(0, 1, 0);
  for (std::size_t i = 0; i < instance.rest.size(); ++i) {
    const Vertex& rest = instance.rest[i];
    const glm::dmat4 matrix = placer.matrix(i);
    const glm::dmat3 linear(matrix);
    const double sign = signOf(glm::determinant(linear));
    Vertex& vertex = vertices[i];
    vertex = rest;
    vertex.position = glm::vec3(placer.position(i, matrix) - origin);

    glm::dvec3 normal;
    if (instance.flatNormals) {
      if (i % 3 == 0 && i + 2 < instance.rest.size()) {
        for (std::size_t k = 0; k < 3; ++k) corners[k] = placer.position(i + k, placer.matrix(i + k));
        flat = unit(flip * glm::cross(corners[1] - corners[0], corners[2] - corners[0]), {0, 1, 0});
      }
      normal = flat;
    } else {
      const glm::dvec3 local = placer.morphed(rest.normal, i, &Instance::MorphTarget::normals);
      normal = unit(normalMatrix(linear, sign) * local, {0, 1, 0});
    }
    const glm::dvec3 along = linear * placer.morphed(glm::dvec3(rest.tangent), i, &Instance::MorphTarget::tangents);
    const glm::dvec3 tangent = unit(along, glm::dvec3(0));
    vertex.normal = glm::vec3(normal);
    vertex.tangent = glm::vec4(
        glm::vec3(unit(tangent - normal * glm::dot(normal, tangent), glm::dvec3(anyPerpendicular(vertex.normal)))),
        static_cast<float>(sign) * rest.tangent.w);
  }
}

void follow(Camera& camera, const glm::dmat4& world, const glm::dvec3& origin) {
  const float distance = glm::length(camera.target - camera.eye);
  const glm::dvec3 forward = unit(-glm::dvec3(world[2]), {0, 0, -1});
  camera.eye = glm::vec3(glm::dvec3(world[3]) - origin);
  camera.target = camera.eye + distance * glm::vec3(forward);
  camera.up = glm::vec3(unit(glm::dvec3(world[1]), {0, 1, 0}));
}

void follow(Light& light, const glm::dmat4& world, const glm::dvec3& origin) {
  light.position = glm::vec3(glm::dvec3(world[3]) - origin);
  light.direction = glm::vec3(unit(-glm::dvec3(world[2]), {0, 0, -1}));
  light.up = glm::vec3(unit(glm::dvec3(world[1]), {0, 1, 0}));
}

bool followLights(std::span<const int> nodes, const PoseState& state, const glm::dvec3& origin,
                  std::span<Light> lights) {
  bool moved = false;
  for (std::size_t i = 0; i < std::min(nodes.size(), lights.size()); ++i) {
    if (nodes[i] < 0) continue;
    const Light before = lights[i];
    follow(lights[i], state.world[static_cast<std::size_t>(nodes[i])], origin);
    moved |=
        before.position != lights[i].position || before.direction != lights[i].direction || before.up != lights[i].up;
  }
  return moved;
}

Camera posedCamera(const Model& model, const PoseState& state, std::size_t camera) {
  if (camera >= model.scene.cameras.size())
    throw Error(ErrorKind::usage, "there is no camera " + std::to_string(camera) + "; the scene has " +
                                      std::to_string(model.scene.cameras.size()));
  Camera posed = model.scene.cameras[camera];
  const int node = camera < model.rig.cameraNodes.size() ? model.rig.cameraNodes[camera] : -1;
  if (node >= 0) follow(posed, state.world[static_cast<std::size_t>(node)], model.scene.origin);
  return posed;
}

SceneChange pose(Model& model, const PoseState& state) {
  Scene& scene = model.scene;
  SceneChange change;
  std::vector<Vertex> moved;
  for (Instance& instance : model.rig.instances) {
    const bool turns = turn(scene, instance, mirrored(model.rig, instance, state));
    moved.resize(instance.rest.size());
    place(model.rig, instance, state, scene.origin, moved);
    for (const Vertex& vertex : moved)
      if (!std::isfinite(vertex.position.x + vertex.position.y + vertex.position.z))
        throw Error(ErrorKind::badInput,
                    "an animation moves the scene out of the range of floats: node " + std::to_string(instance.node));
    Vertex* const old = scene.vertices.data() + instance.firstVertex;
    if (turns) change.turned.push_back({instance.firstTriangle, instance.triangleCount});
    if (moved.empty()) continue;
    if (!turns && std::memcmp(old, moved.data(), moved.size() * sizeof(Vertex)) == 0) continue;
    std::copy(moved.begin(), moved.end(), old);
    if (!change.moved.empty() && change.moved.back().first + change.moved.back().count == instance.firstVertex)
      change.moved.back().count += instance.vertexCount;
    else
      change.moved.push_back({instance.firstVertex, instance.vertexCount});
  }
  change.lights = followLights(model.rig.lightNodes, state, scene.origin, scene.lights);
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) scene.cameras[i] = posedCamera(model, state, i);
  return change;
}

void moveOrigin(Model& model, const glm::dvec3& origin) {
  Scene& scene = model.scene;
  const glm::dvec3 shift = scene.origin - origin;
  const auto shifted = [&shift](const glm::vec3& position) { return glm::vec3(glm::dvec3(position) + shift); };
  for (Vertex& vertex : scene.vertices) vertex.position = shifted(vertex.position);
  for (Light& light : scene.lights) light.position = shifted(light.position);
  for (Camera& camera : scene.cameras) {
    camera.eye = shifted(camera.eye);
    camera.target = shifted(camera.target);
  }
  scene.origin = origin;
  pose(model, std::span<const Playing>());
}

std::optional<glm::dvec3> nearestPosed(const Model& model, const PoseState& state, const glm::dvec3& point) {
  std::optional<glm::dvec3> nearest;
  for (const Instance& instance : model.rig.instances) {
    const std::vector<glm::dvec3> positions = worldPositions(model.rig, instance, state);
    if (positions.empty()) continue;
    glm::dvec3 low = positions.front(), high = low;
    for (const glm::dvec3& position : positions) {
      low = glm::min(low, position);
      high = glm::max(high, position);
    }
    const glm::dvec3 candidate = glm::clamp(point, low, high);
    if (!nearest || glm::distance(candidate, point) < glm::distance(*nearest, point)) nearest = candidate;
  }
  return nearest;
}

SceneChange pose(Model& model, std::span<const Playing> playing) { return pose(model, evaluate(model.rig, playing)); }

}  // namespace halfsilver
