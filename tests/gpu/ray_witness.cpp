#include "gpu/ray_witness.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace halfsilver::testing {
namespace {

class WitnessedTracer final : public Tracer {
 public:
  WitnessedTracer(const gl::Api& api, std::unique_ptr<Tracer> method, std::unique_ptr<Tracer> exact, Witnesses& counts)
      : api_(&api), method_(std::move(method)), exact_(std::move(exact)), counts_(&counts) {}

  void update(const FrameView& view, const SceneChange& change) override {
    method_->update(view, change);
    exact_->update(view, change);
  }
  void trace(const FrameView& view, const RayQueue& rays, Hits& hits) override {
    method_->trace(view, rays, hits);
    compare(view, rays, hits, false);
  }
  void occluded(const FrameView& view, const RayQueue& rays, Hits& hits) override {
    method_->occluded(view, rays, hits);
    compare(view, rays, hits, true);
  }
  bool storesAttributes() const override { return method_->storesAttributes(); }
  TracerMemory memory() const override { return method_->memory(); }
  TracerCounts counts() const override { return method_->counts(); }

 private:
  void compare(const FrameView& view, const RayQueue& rays, const Hits& hits, bool any) {
    if (rays.ofPixels()) return;
    Hits truth;
    truth.hits = gl::Buffer(*api_, hits.hits.bytes(), "true hits");
    if (any)
      exact_->occluded(view, rays, truth);
    else
      exact_->trace(view, rays, truth);
    api_->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    const std::uint32_t count = rays.count.read<shared::RayCount>(1)[0].count;
    const auto paths = rays.paths.read<shared::ScatteredPath>(count);
    const auto found = hits.hits.read<shared::Hit>(count), right = truth.hits.read<shared::Hit>(count);
    for (std::size_t i = 0; i < count; ++i) {
      Witness& witness = (*counts_)[paths[i].kindAndSample & 255u];
      const bool hit = found[i].t >= 0, trulyHit = right[i].t >= 0;
      ++witness.rays;
      witness.hits += trulyHit;
      const bool apart =
          hit != trulyHit || (!any && hit && std::abs(found[i].t - right[i].t) > 1e-3f * view.frame.diagonal);
      const float nearest = hit && trulyHit ? std::min(found[i].t, right[i].t) : std::max(found[i].t, right[i].t);
      if (apart && nearest < 1e-5f * view.frame.diagonal) {
        ++witness.atEdges;
        continue;
      }
      witness.falseOcclusion += hit && !trulyHit;
      witness.falseVisibility += !hit && trulyHit;
      witness.wrongDistance +=
          !any && hit && trulyHit && std::abs(found[i].t - right[i].t) > 1e-3f * view.frame.diagonal;
    }
  }

  const gl::Api* api_;
  std::unique_ptr<Tracer> method_, exact_;
  Witnesses* counts_;
};

}  // namespace

Method witnessedMethod(const std::string& method, const Method& exact, Witnesses& counts) {
  return {{.name = "witnessed", .help = "a method and exact rays"},
          [method, exact, &counts](const gl::Api& api, const Settings& settings) -> std::unique_ptr<Tracer> {
            Settings own = settings;
            own.trace.method = method;
            return std::make_unique<WitnessedTracer>(api, makeTracer(api, own, std::span(&exact, 1)),
                                                     exact.make(api, settings), counts);
          }};
}

std::vector<Method> WitnessTest::methods(const Scene& scene) const {
  std::vector<Method> all = TracingTest::methods(scene);
  all.push_back(witnessedMethod("identity", all.front(), *counts_));
  return all;
}

}  // namespace halfsilver::testing
