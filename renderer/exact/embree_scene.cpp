#include "exact/embree_scene.h"

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

// What the filter needs to know of the rays and writes of their hits; Embree hands the context through.
struct RayContext : RTCIntersectContext {
  const Scene* scene = nullptr;
  bool cullBackFaces = true;
  const Ray* rays = nullptr;  // by RTCRay::id
  Hit* accepted = nullptr;    // likewise
};

RayContext makeContext(const Scene& scene, const RayQuery& query, const Ray* rays, Hit* accepted,
                       RTCFilterFunctionN filter) {
  RayContext context;
  rtcInitIntersectContext(&context);
  context.filter = filter;
  context.scene = &scene;
  context.cullBackFaces = query.cullBackFaces;
  context.rays = rays;
  context.accepted = accepted;
  return context;
}

bool visible(const RayContext& context, const Ray& ray, std::uint32_t number, glm::vec2 barycentrics) {
  if (number == ray.excluded) return false;
  const Scene& scene = *context.scene;
  const Triangle& triangle = scene.triangles[number];
  const Material& material = scene.materials[triangle.material];
  if (context.cullBackFaces && !material.doubleSided) {
    const glm::dvec3 a = scene.vertices[triangle.vertices[0]].position;
    const glm::dvec3 b = scene.vertices[triangle.vertices[1]].position;
    const glm::dvec3 c = scene.vertices[triangle.vertices[2]].position;
    if (glm::dot(glm::cross(b - a, c - a), glm::dvec3(ray.direction)) > 0) return false;
  }
  return !cutAway(scene, number, barycentrics);
}

// Called for hits that are no farther than the last one that was accepted: that one stands if it is as near and has the
// lower number, so that neither the hierarchy nor the rays beside it have a say.
void filter(const RTCFilterFunctionNArguments* arguments) {
  const auto& context = *static_cast<const RayContext*>(arguments->context);
  const unsigned lanes = arguments->N;
  for (unsigned lane = 0; lane < lanes; ++lane) {
    if (arguments->valid[lane] == 0) continue;
    const unsigned id = RTCRayN_id(arguments->ray, lanes, lane);
    const std::uint32_t number = RTCHitN_primID(arguments->hit, lanes, lane);
    const float t = RTCRayN_tfar(arguments->ray, lanes, lane);
    const glm::vec2 barycentrics(RTCHitN_u(arguments->hit, lanes, lane), RTCHitN_v(arguments->hit, lanes, lane));
    Hit& accepted = context.accepted[id];
    const bool tied = accepted.t == t && accepted.triangle < number;
    if (!tied && visible(context, context.rays[id], number, barycentrics))
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

void EmbreeScene::build(Quality quality) {
  const RTCBuildQuality wanted = quality == Quality::fastTrace ? RTC_BUILD_QUALITY_MEDIUM : RTC_BUILD_QUALITY_LOW;
  scene_.reset();  // its memory goes before the new one's comes
  std::unique_ptr<RTCSceneTy, SceneRelease> scene(rtcNewScene(device_.get()));
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
  rtcSetSceneBuildQuality(scene.get(), wanted);
  RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetGeometryBuildQuality(geometry, wanted);
  // The scene's own arrays; Vertex is larger than the 16 bytes that Embree reads at each position.
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, source_->vertices.data(),
                             offsetof(Vertex, position), sizeof(Vertex), source_->vertices.size());
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, source_->triangles.data(),
                             offsetof(Triangle, vertices), sizeof(Triangle), source_->triangles.size());
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene.get());
  if (rtcGetDeviceError(device_.get()) != RTC_ERROR_NONE)
    throw Error(ErrorKind::failed, "Embree cannot build the scene");
  scene_ = std::move(scene);
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
  RayContext context = makeContext(*source_, query, &ray, &hit, filter);
  RTCRayHit one{};
  one.ray.org_x = ray.origin.x;
  one.ray.org_y = ray.origin.y;
  one.ray.org_z = ray.origin.z;
  one.ray.dir_x = ray.direction.x;
  one.ray.dir_y = ray.direction.y;
  one.ray.dir_z = ray.direction.z;
  one.ray.tnear = query.minDistance;
  one.ray.tfar = ray.maxDistance;
  one.ray.mask = ~0u;
  one.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  if (query.any)
    rtcOccluded1(scene_.get(), &context, &one.ray);
  else
    rtcIntersect1(scene_.get(), &context, &one);
}

void EmbreeScene::tracePacket(const Ray* rays, const RayQuery& query, Hit* hits) const {
  RayContext context = makeContext(*source_, query, rays, hits, filter);
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
    packet.ray.tnear[i] = query.minDistance;
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
