#include "tracing/bvh/bvh_tracer.h"

#include <algorithm>
#include <thread>

namespace halfsilver {
namespace {

constexpr unsigned kThreads = 2;
// A tree whose cost has grown by more than this through refits is rebuilt.
constexpr double kMaxCostGrowth = 1.3;
// The exact test takes hits that pass a triangle by its rounding, which is below this share of the scene's diagonal.
constexpr float kMargin = 1.0f / (1 << 20);

void replace(const gl::Api& api, std::size_t bytes, const char* label, gl::Buffer& buffer) {
  if (buffer.bytes() == bytes) return;
  buffer = gl::Buffer();  // the old memory goes before the new comes
  buffer = gl::Buffer(api, bytes, label);
}

}  // namespace

Method BvhTracer::method() {
  return {{.name = "bvh",
           .help = "hierarchy of boxes built on the CPU, exact test",
           .settings = {"trace.stage", "trace.count_work"},
           .exact = true},
          [](const gl::Api& api, const Settings& settings) { return std::make_unique<BvhTracer>(api, settings); }};
}

BvhTracer::BvhTracer(const gl::Api& api, const Settings& settings)
    : api_(&api), tracePass_(api, settings.trace, "tracing/bvh") {}

void BvhTracer::readScene(const GpuScene& scene) {
  triangles_ = scene.triangles.read<glm::uvec4>(scene.triangleCount);
  positions_ = scene.positions.read<glm::vec3>(scene.vertexCount);
}

void BvhTracer::readMoved(const GpuScene& scene, const std::vector<VertexRange>& moved) {
  for (const VertexRange& range : moved) {
    const std::vector<glm::vec3> values = scene.positions.read<glm::vec3>(range.count, range.first);
    std::copy(values.begin(), values.end(), positions_.begin() + range.first);
  }
}

std::vector<Bounds> BvhTracer::boxes() const {
  const float margin = kMargin * glm::length(grid_.extent);
  std::vector<Bounds> result(triangles_.size());
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    for (int corner = 0; corner < 3; ++corner) result[i].add(positions_[triangles_[i][corner]]);
    result[i].low -= margin;
    result[i].high += margin;
  }
  return result;
}

void BvhTracer::update(const FrameView& view, const SceneChange& change) {
  const bool kept = built_ && !change.topology;
  if (kept && change.moved.empty()) return;
  const auto scope = view.profiler.hostSection("build");
  built_ = false;  // until nothing has failed
  grid_ = makeGrid(view.scene.extents.bounds(), 1, 1);
  if (kept) {
    readMoved(view.scene, change.moved);
    refitBvh(boxes(), bvh_);
  } else {
    readScene(view.scene);
  }
  if (!kept || bvh_.cost > kMaxCostGrowth * builtCost_) build();
  replace(*api_, bvh_.nodes.size() * sizeof(shared::BvhNode), "bvh nodes", nodes_);
  replace(*api_, std::max<std::size_t>(1, bvh_.triangles.size()) * sizeof(GLuint), "bvh triangles", numbers_);
  nodes_.write(std::span<const shared::BvhNode>(bvh_.nodes));
  numbers_.write(std::span<const std::uint32_t>(bvh_.triangles));
  built_ = true;
}

void BvhTracer::build() {
  bvh_ = buildBvh(boxes(), std::min(kThreads, std::max(1u, std::thread::hardware_concurrency())));
  builtCost_ = bvh_.cost;
}

void BvhTracer::trace(const FrameView& view, const RayQueue& rays, Hits& hits) {
  grid_.apply(tracePass_.program());
  tracePass_.run(view, rays, hits, {[this] {
                   nodes_.bindStorage(SSBO_BVH_NODES);
                   numbers_.bindStorage(SSBO_BVH_TRIANGLES);
                 }});
}

TracerMemory BvhTracer::memory() const {
  TracerMemory memory;
  memory.structureTotal = nodes_.bytes() + numbers_.bytes();
  memory.transient = tracePass_.bytes();
  return memory;
}

}  // namespace halfsilver
