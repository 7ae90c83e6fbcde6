#include <halfsilver/exact.h>

#include <embree3/rtcore.h>

#include <algorithm>
#include <atomic>
#include <span>
#include <string>
#include <thread>

#include <halfsilver/error.h>
#include <halfsilver/ray_reader.h>
#include "scene/alpha.h"

namespace halfsilver {
namespace {

using shared::Hit;
using shared::Ray;

struct DeviceRelease {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneRelease {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<RTCDeviceTy, DeviceRelease>;
using EmbreeScene = std::unique_ptr<RTCSceneTy, SceneRelease>;

// What the filter needs to know of the ray; Embree hands the context through.
struct RayContext : RTCIntersectContext {
  const Scene* scene = nullptr;
  bool cullBackFaces = true;
  std::uint32_t excluded = NO_TRIANGLE;
  glm::vec3 direction{0};
  Hit accepted{HIT_MISS, NO_TRIANGLE, 0, 0};  // by the filter, the last
};

bool visible(const RayContext& context, std::uint32_t number, glm::vec2 barycentrics) {
  if (number == context.excluded) return false;
  const Scene& scene = *context.scene;
  const Triangle& triangle = scene.triangles[number];
  const Material& material = scene.materials[triangle.material];
  if (context.cullBackFaces && !material.doubleSided) {
    const glm::dvec3 a = scene.vertices[triangle.vertices[0]].position;
    const glm::dvec3 b = scene.vertices[triangle.vertices[1]].position;
    const glm::dvec3 c = scene.vertices[triangle.vertices[2]].position;
    if (glm::dot(glm::cross(b - a, c - a), glm::dvec3(context.direction)) > 0) return false;
  }
  return !cutAway(scene, number, barycentrics);
}

void filter(const RTCFilterFunctionNArguments* arguments) {
  if (arguments->valid[0] == 0) return;
  auto& context = *static_cast<RayContext*>(arguments->context);
  const unsigned number = RTCHitN_primID(arguments->hit, 1, 0);
  const glm::vec2 barycentrics(RTCHitN_u(arguments->hit, 1, 0), RTCHitN_v(arguments->hit, 1, 0));
  if (visible(context, number, barycentrics))
    context.accepted = {RTCRayN_tfar(arguments->ray, 1, 0), number, barycentrics.x, barycentrics.y};
  else
    arguments->valid[0] = 0;
}

bool countMemory(void* total, ssize_t bytes, bool) {
  static_cast<std::atomic<std::int64_t>*>(total)->fetch_add(bytes);
  return true;
}

class ExactTracer final : public Tracer {
 public:
  ExactTracer(const gl::Api& api, const Scene& scene, int threads)
      : scene_(&scene),
        threads_(threads > 0 ? static_cast<unsigned>(threads) : std::max(1u, std::thread::hardware_concurrency())),
        device_(rtcNewDevice(("threads=" + std::to_string(threads_)).c_str())),
        rayReader_(api) {
    if (!device_) throw Error(ErrorKind::failed, "Embree cannot make a device");
    rtcSetDeviceMemoryMonitorFunction(device_.get(), countMemory, &bytes_);
  }

  void update(const FrameView& view, const SceneChange& change) override {
    if (embreeScene_ && !change.geometry()) return;
    const auto scope = view.profiler.hostSection("build");
    // What moves will move again: a hierarchy that is made faster than it traces. Refitting the old one is no faster.
    const bool moves = embreeScene_ && !change.topology;
    embreeScene_.reset();
    embreeScene_ = build(moves ? RTC_BUILD_QUALITY_LOW : RTC_BUILD_QUALITY_MEDIUM);
  }

  void trace(const FrameView& view, const RayQueue& rays, Hits& hits) override {
    answer(view, rays, hits, [this, &view](const Ray& ray) { return nearestHit(ray, view.frame); });
  }

  void occluded(const FrameView& view, const RayQueue& rays, Hits& hits) override {
    answer(view, rays, hits, [this, &view](const Ray& ray) { return anyHit(ray, view.frame); });
  }

  TracerMemory memory() const override {
    TracerMemory memory;
    memory.structureTotal = static_cast<std::uint64_t>(std::max<std::int64_t>(0, bytes_.load()));
    return memory;
  }

 private:
  EmbreeScene build(RTCBuildQuality quality) const {
    EmbreeScene scene(rtcNewScene(device_.get()));
    rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
    rtcSetSceneBuildQuality(scene.get(), quality);
    RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetGeometryBuildQuality(geometry, quality);
    // The scene's own arrays; Vertex is larger than the 16 bytes that Embree reads at each position.
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, scene_->vertices.data(),
                               offsetof(Vertex, position), sizeof(Vertex), scene_->vertices.size());
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, scene_->triangles.data(),
                               offsetof(Triangle, vertices), sizeof(Triangle), scene_->triangles.size());
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene.get());
    if (rtcGetDeviceError(device_.get()) != RTC_ERROR_NONE)
      throw Error(ErrorKind::failed, "Embree cannot build the scene");
    return scene;
  }

  // Valid until the next call.
  std::span<const Ray> read(const FrameView& view, const RayQueue& rays) {
    rayReader_.submit(view, rays, 0);
    return rayReader_.rays(view, rays);
  }

  // Writes `query(ray)` for every ray of the queue.
  template <class Query>
  void answer(const FrameView& view, const RayQueue& queue, Hits& hits, const Query& query) {
    const auto scope = view.profiler.hostSection("trace");
    const std::span<const Ray> rays = read(view, queue);
    std::vector<Hit> results(rays.size());
    constexpr std::size_t kChunk = 1024;
    std::atomic<std::size_t> next{0};
    const auto work = [&] {
      for (std::size_t first = next.fetch_add(kChunk); first < rays.size(); first = next.fetch_add(kChunk))
        for (std::size_t i = first; i < std::min(first + kChunk, rays.size()); ++i) results[i] = query(rays[i]);
    };
    {
      std::vector<std::jthread> helpers;
      for (unsigned i = 1; i < threads_; ++i) helpers.emplace_back(work);
      work();
    }
    hits.hits.write(std::span<const Hit>(results));
  }

  RayContext contextOf(const Ray& ray, const shared::FrameConstants& frame) const {
    RayContext context;
    rtcInitIntersectContext(&context);
    context.filter = filter;
    context.scene = scene_;
    context.cullBackFaces = frame.cullBackFaces != 0;
    context.excluded = ray.excluded;
    context.direction = ray.direction;
    return context;
  }

  static RTCRay embreeRay(const Ray& ray, const shared::FrameConstants& frame) {
    RTCRay query{};
    query.org_x = ray.origin.x;
    query.org_y = ray.origin.y;
    query.org_z = ray.origin.z;
    query.dir_x = ray.direction.x;
    query.dir_y = ray.direction.y;
    query.dir_z = ray.direction.z;
    query.tnear = frame.minDistance;
    query.tfar = ray.maxDistance;
    query.mask = ~0u;
    return query;
  }

  Hit nearestHit(const Ray& ray, const shared::FrameConstants& frame) const {
    RayContext context = contextOf(ray, frame);
    RTCRayHit query{};
    query.ray = embreeRay(ray, frame);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(embreeScene_.get(), &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {HIT_MISS, NO_TRIANGLE, 0, 0};
    return {query.ray.tfar, query.hit.primID, query.hit.u, query.hit.v};
  }

  // Embree says only whether there is one; the filter knows which.
  Hit anyHit(const Ray& ray, const shared::FrameConstants& frame) const {
    RayContext context = contextOf(ray, frame);
    RTCRay query = embreeRay(ray, frame);
    rtcOccluded1(embreeScene_.get(), &context, &query);
    return context.accepted;
  }

  const Scene* scene_;
  unsigned threads_;
  std::atomic<std::int64_t> bytes_{0};
  Device device_;
  EmbreeScene embreeScene_;
  RayReader rayReader_;
};

}  // namespace

TracerFactory makeExactTracerFactory(const Scene& scene, int threads) {
  return [&scene, threads](const gl::Api& api, const Settings&) -> std::unique_ptr<Tracer> {
    return std::make_unique<ExactTracer>(api, scene, threads);
  };
}

}  // namespace halfsilver
