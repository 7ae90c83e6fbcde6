#include <halfsilver/exact.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <thread>
#include <utility>
#include <vector>

#include <halfsilver/error.h>
#include <halfsilver/ray_reader.h>
#include "exact/embree_scene.h"
#include "exact/posed_scene.h"
#include "exact/worker_pool.h"

namespace halfsilver {
namespace {

using shared::Hit;
using shared::Ray;

constexpr std::size_t kChunk = 1024;  // rays that one thread takes at once

class ExactTracer final : public Tracer {
 public:
  ExactTracer(const gl::Api& api, const Scene& scene, unsigned threads)
      : api_(&api), source_(&scene), scene_(scene, threads), reader_(api), pool_(threads) {}

  void update(const FrameView& view, const SceneChange& change) override {
    const bool kept = built_ && !change.topology;
    if (posed_ && change.materials) {
      waitForJobs();
      posed_->copyMaterials(*source_);
    }
    if (kept && !change.geometry()) return;
    const auto scope = view.profiler.hostSection("build");
    built_ = false;  // until nothing has failed
    waitForJobs();
    if (!view.scene.extents.posed().empty()) followPoses(view.scene, change);
    if (kept)
      scene_.follow(change.moved);
    else
      scene_.build();
    built_ = true;
  }

  void forget() override {
    waitForJobs();
    built_ = false;
  }

  void trace(const FrameView& view, const RayQueue& rays, Hits& hits) override {
    submit(view, rays, hits);
    collect(view, rays, hits);
  }

  void occluded(const FrameView& view, const RayQueue& rays, Hits& hits) override {
    begin(view, rays, true);
    collect(view, rays, hits);
  }

  void submit(const FrameView& view, const RayQueue& rays, Hits&) override { begin(view, rays, false); }

  void collect(const FrameView& view, const RayQueue& rays, Hits& hits) override {
    Work& work = workOf(rays);
    if (!work.job) start(view, work);
    pool_.wait(*work.job);
    view.profiler.add("trace", work.job->milliseconds());
    hits.hits.write(std::span<const Hit>(work.hits));
    work.queue = nullptr;
    work.job.reset();
  }

  TracerMemory memory() const override {
    TracerMemory memory;
    memory.structureTotal = scene_.bytes() + (posed_ ? posed_->bytes() : 0);
    for (const std::unique_ptr<Work>& work : works_)
      memory.transient += work->reader.bytes() + work->hits.capacity() * sizeof(Hit);
    return memory;
  }

 private:
  // A queue on its way.
  struct Work {
    explicit Work(RayReader rayReader) : reader(std::move(rayReader)) {}
    const RayQueue* queue = nullptr;  // null: free
    RayQuery query;
    RayReader reader;
    std::vector<Hit> hits;
    std::shared_ptr<const WorkerPool::Job> job;  // null: the rays have not arrived
  };

  // That of the queue, or a free one. A frame that was dropped leaves its own, which the next frame in its memory
  // takes.
  Work& workOf(const RayQueue& queue) {
    for (const RayQueue* wanted : {&queue, static_cast<const RayQueue*>(nullptr)})
      for (const std::unique_ptr<Work>& work : works_)
        if (work->queue == wanted) return *work;
    return *works_.emplace_back(std::make_unique<Work>(reader_.another()));
  }

  // What is posed on the GPU is traced as it is there.
  void followPoses(const GpuScene& scene, const SceneChange& change) {
    if (posed_) return posed_->follow(scene, change);
    posed_.emplace(*source_, scene);
    scene_.use(posed_->scene());
  }

  // Jobs of another frame under way, or of one that failed, still trace what a build replaces.
  void waitForJobs() {
    for (const std::unique_ptr<Work>& work : works_)
      if (work->job) pool_.wait(*work->job);
  }

  void begin(const FrameView& view, const RayQueue& rays, bool any) {
    Work& work = workOf(rays);
    if (work.job) pool_.wait(*work.job);
    work.job.reset();
    work.queue = &rays;
    work.query = {view.frame.minDistance, view.frame.cullBackFaces != 0, any, view.frame.blends != 0};
    work.reader.submit(view, rays, likely_);
    // A software rasterizer keeps the host from coming back before the deferred shading is done, and has the rays now.
    if (api_->software || work.reader.ready()) start(view, work);
  }

  void start(const FrameView& view, Work& work) {
    if (!scene_.ready()) throw Error(ErrorKind::failed, "the rays have no scene: its last build failed");
    const std::span<const Ray> rays = work.reader.rays(view, *work.queue);
    const auto count = static_cast<std::uint32_t>(rays.size());
    likely_ = std::max(count, likely_ - likely_ / 8);
    work.hits.resize(count);
    work.job = pool_.start((rays.size() + kChunk - 1) / kChunk, [this, &work, rays](std::size_t chunk) {
      const std::size_t first = chunk * kChunk, size = std::min(kChunk, rays.size() - first);
      scene_.trace(rays.subspan(first, size), work.query, std::span(work.hits).subspan(first, size));
    });
  }

  const gl::Api* api_;
  const Scene* source_;
  std::optional<PosedScene> posed_;  // if poses move the scene
  EmbreeScene scene_;
  bool built_ = false;  // for the geometry of the last update
  RayReader reader_;    // whose program the works share
  std::vector<std::unique_ptr<Work>> works_;
  std::uint32_t likely_ = 0;  // rays in the next queue
  WorkerPool pool_;           // its threads end before what they work on
};

}  // namespace

TracerFactory makeExactTracerFactory(const Scene& scene, int threads) {
  return [&scene, threads](const gl::Api& api, const Settings&) -> std::unique_ptr<Tracer> {
    const unsigned count =
        threads > 0 ? static_cast<unsigned>(threads) : std::max(1u, std::thread::hardware_concurrency());
    return std::make_unique<ExactTracer>(api, scene, count);
  };
}

}  // namespace halfsilver
