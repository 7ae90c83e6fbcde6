#include "exact/embree_scene.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include <halfsilver/error.h>
#include "scene/alpha.h"

namespace halfsilver {
namespace {

using shared::Hit;
using shared::Ray;

constexpr std::size_t kPacket = 8;
// Of two directions in a packet. Rays of a flat mirror's neighboring pixels are far closer together; those that a bumpy
// one scatters are faster alone.
constexpr float kMinCosine = 0.998f;
// Triangles that have moved stay in the hierarchy of those that have not, as ghosts that no ray sees, until there is
// one to this many others.
constexpr std::size_t kGhosts = 8;

// What the filter needs to know of the rays and writes of their hits; Embree hands the context through.
struct RayContext : RTCIntersectContext {
  const Scene* scene = nullptr;
  const EmbreeParts* parts = nullptr;
  RayQuery query;
  const Ray* rays = nullptr;  // by RTCRay::id
  Hit* accepted = nullptr;    // likewise
};

RayContext makeContext(const Scene& scene, const EmbreeParts& parts, const RayQuery& query, const Ray* rays,
                       Hit* accepted, RTCFilterFunctionN filter) {
  RayContext context;
  rtcInitIntersectContext(&context);
  context.filter = filter;
  context.scene = &scene;
  context.parts = &parts;
  context.query = query;
  context.rays = rays;
  context.accepted = accepted;
  return context;
}

float nearestOf(const Ray& ray, const RayQuery& query) {
  const glm::vec3 size = glm::abs(ray.origin);
  return std::min(NEAREST_SHARE * std::max({size.x, size.y, size.z}), query.minDistance);
}

// See startsInPlane() of test_candidate.glsl.
bool visible(const RayContext& context, const Ray& ray, std::uint32_t number, double t, glm::vec2 barycentrics) {
  if (number == ray.excluded) return false;
  const Scene& scene = *context.scene;
  const Triangle& triangle = scene.triangles[number];
  const Material& material = scene.materials[triangle.material];
  const glm::dvec3 a = scene.vertices[triangle.vertices[0]].position;
  const glm::dvec3 b = scene.vertices[triangle.vertices[1]].position;
  const glm::dvec3 c = scene.vertices[triangle.vertices[2]].position;
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double along = glm::dot(normal, glm::dvec3(ray.direction));
  if (context.query.cullBackFaces && !seenFromBehind(material) && along > 0) return false;
  const glm::dvec3 origin(ray.origin);
  const glm::dvec3 size = glm::max(glm::max(glm::abs(a), glm::abs(b)), glm::max(glm::abs(c), glm::abs(origin)));
  constexpr double kShare = static_cast<double>(NEAREST_SHARE);
  const auto least = static_cast<double>(nearestOf(ray, context.query));
  const double off = std::max(kShare * glm::dot(glm::abs(normal), size), least * glm::length(normal));
  const double reach = std::max({glm::distance(a, origin), glm::distance(b, origin), glm::distance(c, origin)});
  if (t <= 64 * std::max(kShare * reach, least) && std::abs(glm::dot(normal, a - origin)) <= off) return false;
  return !cutAway(scene, number, barycentrics, context.query.blends);
}

// Called for hits that are no farther than the last one that was accepted: that one stands if it is as near and has the
// lower number, so that neither the hierarchy nor the rays beside it have a say.
void filter(const RTCFilterFunctionNArguments* arguments) {
  const auto& context = *static_cast<const RayContext*>(arguments->context);
  const unsigned lanes = arguments->N;
  for (unsigned lane = 0; lane < lanes; ++lane) {
    if (arguments->valid[lane] == 0) continue;
    const unsigned id = RTCRayN_id(arguments->ray, lanes, lane);
    const unsigned geometry = RTCHitN_geomID(arguments->hit, lanes, lane);
    const std::uint32_t number = context.parts->number(geometry, RTCHitN_primID(arguments->hit, lanes, lane));
    const float t = RTCRayN_tfar(arguments->ray, lanes, lane);
    const glm::vec2 barycentrics(RTCHitN_u(arguments->hit, lanes, lane), RTCHitN_v(arguments->hit, lanes, lane));
    Hit& accepted = context.accepted[id];
    const bool tied = accepted.t == t && accepted.triangle < number;
    const bool ghost = geometry == EmbreeParts::kStill && context.parts->moves[number];
    if (!tied && !ghost && visible(context, context.rays[id], number, static_cast<double>(t), barycentrics))
      accepted = {t, number, barycentrics.x, barycentrics.y};
    else
      arguments->valid[lane] = 0;
  }
}

bool goTheSameWay(const Ray* rays) {
  for (std::size_t i = 1; i < kPacket; ++i)
    if (glm::dot(rays[i].direction, rays[0].direction) < kMinCosine) return false;
  return true;
}

bool countMemory(void* total, ssize_t bytes, bool) {
  static_cast<std::atomic<std::int64_t>*>(total)->fetch_add(bytes);
  return true;
}

}  // namespace

EmbreeScene::EmbreeScene(const Scene& scene, unsigned threads)
    : source_(&scene), device_(rtcNewDevice(("threads=" + std::to_string(threads)).c_str())) {
  if (!device_) throw Error(ErrorKind::failed, "Embree cannot make a device");
  rtcSetDeviceMemoryMonitorFunction(device_.get(), countMemory, &bytes_);
  packets_ = rtcGetDeviceProperty(device_.get(), RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED) != 0;
}

std::uint64_t EmbreeScene::bytes() const {
  const std::size_t numbers =
      parts_.still.capacity() + parts_.moving.capacity() + stillIndices_.capacity() + movingIndices_.capacity();
  return static_cast<std::uint64_t>(std::max<std::int64_t>(0, bytes_.load())) + numbers * sizeof(std::uint32_t) +
         (parts_.moves.capacity() + movedVertices_.capacity()) / 8;
}

EmbreeScene::Geometry EmbreeScene::makeGeometry(RTCBuildQuality quality) const {
  Geometry geometry(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
  rtcSetGeometryBuildQuality(geometry.get(), quality);
  // The scene's own array; Vertex is larger than the 16 bytes that Embree reads at each position.
  rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, source_->vertices.data(),
                             offsetof(Vertex, position), sizeof(Vertex), source_->vertices.size());
  return geometry;
}

void EmbreeScene::build() {
  scene_.reset();  // its memory goes before the new one's comes
  moving_.reset();
  parts_ = {};
  parts_.moves.resize(source_->triangles.size());
  movedVertices_.assign(source_->vertices.size(), false);
  std::unique_ptr<RTCSceneTy, SceneRelease> scene(rtcNewScene(device_.get()));
  rtcSetSceneFlags(scene.get(),
                   RTC_SCENE_FLAG_DYNAMIC | RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
  // Hierarchies of geometries are joined; of one geometry it is the one that the geometry asks for.
  rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_LOW);
  scene_ = std::move(scene);
  makeStill();
  commit();
}

// The geometry of what has not moved.
void EmbreeScene::makeStill() {
  ghosts_ = 0;
  const Geometry still = makeGeometry(RTC_BUILD_QUALITY_MEDIUM);
  if (parts_.moving.empty()) {
    rtcSetSharedGeometryBuffer(still.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, source_->triangles.data(),
                               offsetof(Triangle, vertices), sizeof(Triangle), source_->triangles.size());
  } else {
    rtcDetachGeometry(scene_.get(), EmbreeParts::kStill);
    parts_.still.clear();
    for (std::size_t t = 0; t < parts_.moves.size(); ++t)
      if (!parts_.moves[t]) parts_.still.push_back(static_cast<std::uint32_t>(t));
    if (parts_.still.empty()) return;
    setIndices(still, parts_.still, stillIndices_);
  }
  rtcCommitGeometry(still.get());
  rtcAttachGeometryByID(scene_.get(), still.get(), EmbreeParts::kStill);
}

void EmbreeScene::follow(std::span<const VertexRange> moved) {
  if (noteMoves(moved)) {
    if (moving_) rtcDetachGeometry(scene_.get(), EmbreeParts::kMoving);
    moving_ = makeGeometry(RTC_BUILD_QUALITY_LOW);
    rtcAttachGeometryByID(scene_.get(), moving_.get(), EmbreeParts::kMoving);
    if (kGhosts * ghosts_ > parts_.moves.size() - parts_.moving.size()) makeStill();
  }
  if (!moving_) return;
  setIndices(moving_, parts_.moving, movingIndices_);
  rtcUpdateGeometryBuffer(moving_.get(), RTC_BUFFER_TYPE_VERTEX, 0);
  rtcCommitGeometry(moving_.get());
  commit();
}

// Returns whether triangles moved that had not moved before.
bool EmbreeScene::noteMoves(std::span<const VertexRange> moved) {
  bool first = false;
  for (const VertexRange& range : moved)
    for (std::uint32_t vertex = range.first; vertex < range.first + range.count; ++vertex) {
      first |= !movedVertices_[vertex];
      movedVertices_[vertex] = true;
    }
  if (!first) return false;
  const std::size_t before = parts_.moving.size();
  parts_.moving.clear();
  for (std::size_t t = 0; t < source_->triangles.size(); ++t) {
    const auto& vertices = source_->triangles[t].vertices;
    if (!std::any_of(vertices.begin(), vertices.end(), [this](std::uint32_t v) { return movedVertices_[v]; })) continue;
    parts_.moves[t] = true;
    parts_.moving.push_back(static_cast<std::uint32_t>(t));
  }
  ghosts_ += parts_.moving.size() - before;
  return parts_.moving.size() > before;
}

// The vertices of the numbered triangles as they are now, into memory that Embree reads in place.
void EmbreeScene::setIndices(const Geometry& geometry, std::span<const std::uint32_t> numbers,
                             std::vector<std::uint32_t>& indices) const {
  indices.clear();
  for (const std::uint32_t number : numbers) {
    const auto& vertices = source_->triangles[number].vertices;
    indices.insert(indices.end(), vertices.begin(), vertices.end());
  }
  rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, indices.data(), 0,
                             3 * sizeof(std::uint32_t), numbers.size());
}

void EmbreeScene::commit() {
  rtcCommitScene(scene_.get());
  if (rtcGetDeviceError(device_.get()) == RTC_ERROR_NONE) return;
  scene_.reset();
  throw Error(ErrorKind::failed, "Embree cannot build the scene");
}

void EmbreeScene::trace(std::span<const Ray> rays, const RayQuery& query, std::span<Hit> hits) const {
  for (std::size_t i = 0; i < rays.size();) {
    if (packets_ && i + kPacket <= rays.size() && goTheSameWay(&rays[i])) {
      tracePacket(&rays[i], query, &hits[i]);
      i += kPacket;
    } else {
      traceOne(rays[i], query, hits[i]);
      ++i;
    }
  }
}

void EmbreeScene::traceOne(const Ray& ray, const RayQuery& query, Hit& hit) const {
  hit = {HIT_MISS, NO_TRIANGLE, 0, 0};
  RayContext context = makeContext(*source_, parts_, query, &ray, &hit, filter);
  RTCRayHit one{};
  one.ray.org_x = ray.origin.x;
  one.ray.org_y = ray.origin.y;
  one.ray.org_z = ray.origin.z;
  one.ray.dir_x = ray.direction.x;
  one.ray.dir_y = ray.direction.y;
  one.ray.dir_z = ray.direction.z;
  one.ray.tnear = nearestOf(ray, query);
  one.ray.tfar = ray.maxDistance;
  one.ray.mask = ~0u;
  one.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  if (query.any)
    rtcOccluded1(scene_.get(), &context, &one.ray);
  else
    rtcIntersect1(scene_.get(), &context, &one);
}

void EmbreeScene::tracePacket(const Ray* rays, const RayQuery& query, Hit* hits) const {
  RayContext context = makeContext(*source_, parts_, query, rays, hits, filter);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  RTCRayHit8 packet;
  alignas(32) int valid[kPacket];
  for (std::size_t i = 0; i < kPacket; ++i) {
    const Ray& ray = rays[i];
    hits[i] = {HIT_MISS, NO_TRIANGLE, 0, 0};
    valid[i] = -1;
    packet.ray.org_x[i] = ray.origin.x;
    packet.ray.org_y[i] = ray.origin.y;
    packet.ray.org_z[i] = ray.origin.z;
    packet.ray.dir_x[i] = ray.direction.x;
    packet.ray.dir_y[i] = ray.direction.y;
    packet.ray.dir_z[i] = ray.direction.z;
    packet.ray.tnear[i] = nearestOf(ray, query);
    packet.ray.tfar[i] = ray.maxDistance;
    packet.ray.time[i] = 0;
    packet.ray.mask[i] = ~0u;
    packet.ray.flags[i] = 0;
    packet.ray.id[i] = static_cast<unsigned>(i);
    packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
  }
  if (query.any)
    rtcOccluded8(valid, scene_.get(), &context, &packet.ray);
  else
    rtcIntersect8(valid, scene_.get(), &context, &packet);
}

}  // namespace halfsilver
