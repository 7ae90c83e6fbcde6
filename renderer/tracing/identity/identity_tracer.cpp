#include "tracing/identity/identity_tracer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace halfsilver {
namespace {

// Bricks on a waiting ray's way that are built with the one it waits for; doubled each time that rays wait again. Few
// and many small builds, or fewer builds of lists that nobody needs.
constexpr int kFirstLookAhead = 2;
constexpr int kKeptLookAhead = 1;  // if most bricks are there from earlier frames: another build costs little
constexpr int kMaxLookAhead = 4096;
// Dispatches before the host looks whether rays still wait: as many as they mostly need.
constexpr int kFirstDispatches = 6, kKeptDispatches = 6;

// Bit by bit: what differs at all may make other rays.
auto wordsOf(const shared::FrameConstants& frame) {
  return std::bit_cast<std::array<std::uint32_t, sizeof(frame) / sizeof(std::uint32_t)>>(frame);
}

}  // namespace

Method IdentityTracer::method() {
  return {{.name = "identity",
           .help = "fragments that name their triangle, exact ray/triangle test",
           .settings = {"voxels.resolution", "voxels.per_triangle", "voxels.axis", "abuffer.keep", "trace.stage",
                        "trace.count_work"},
           .preset = "halfsilver",
           .knobs = {{"voxels.per_triangle", {"2", "4", "8", "16", "32", "64"}}},
           .exact = true},
          [](const gl::Api& api, const Settings& settings) { return std::make_unique<IdentityTracer>(api, settings); }};
}

IdentityTracer::IdentityTracer(const gl::Api& api, const Settings& settings)
    : keep_(settings.identity.keep),
      store_(api, settings),
      builder_(api),
      request_(gl::Program::compute(api, "tracing/identity/request.comp")),
      tracePass_(api, settings.trace, "tracing/identity") {}

void IdentityTracer::update(const FrameView& view, const SceneChange& change) {
  store_.beginFrame();
  builder_.beginFrame();
  const bool kept = keep_ && built_ && store_.complete() && !change.topology;
  if (!kept || change.any())
    for (Traces& each : traces_) each.dispatches.assign(each.count, 0);  // not known any more
  latest_ = (latest_ + 1) % traces_.size();
  traces_[latest_] = {&view.constants, view.frame, 0, {}};
  dispatchesToLook_ = kKeptDispatches;
  firstLookAhead_ = kKeptLookAhead;
  few_ = true;
  kept_ = kept;
  if (kept && change.moved.empty()) return;
  built_ = false;  // until nothing has failed
  store_.setOuter(view.scene.extents.core().outer);
  const bool suits = store_.suits(view.scene);
  if (kept && store_.ownAxis() && suits) {
    const auto scope = view.profiler.section("voxelize");
    if (store_.stuck()) {
      store_.forget(view.scene);
      builder_.clearCounters();
      few_ = false;
    }
    builder_.followMoved(view.scene, change.moved, store_);
  } else {
    // What has left the grid will move on.
    store_.start(view, store_.brickGridOf(view.scene, kept && !suits));
    {
      const auto scope = view.profiler.section("voxelize");
      builder_.measure(view.scene, store_);
    }
    builder_.clearCounters();
    firstLookAhead_ = kFirstLookAhead;
    dispatchesToLook_ = kFirstDispatches;
    few_ = false;
  }
  built_ = true;
}

void IdentityTracer::trace(const FrameView& view, const RayQueue& rays, Hits& hits) {
  const gl::Program& program = tracePass_.program();
  store_.grid().apply(program);
  store_.entryLayout().apply(program);
  TracePass::Structure structure;
  structure.bind = [&] {
    store_.bind();
    store_.bindOuter();
    if (!structure.certain) builder_.bindRequests();
  };
  std::size_t own = latest_;  // a later frame may have begun
  for (std::size_t i = 1; i < traces_.size() && traces_[own].constants != &view.constants; ++i)
    own = (own + traces_.size() - 1) % traces_.size();
  Traces& traces = traces_[own];
  const std::size_t number = traces.count++;
  // Equal constants make equal rays, and all that those need is there.
  for (const Traces& each : traces_) {
    if (number >= each.dispatches.size() || each.dispatches[number] == 0) continue;
    if (wordsOf(each.frame) != wordsOf(traces.frame)) continue;
    structure.dispatches = each.dispatches[number];
    structure.certain = true;
  }
  if (structure.certain) {
    traces.dispatches.push_back(tracePass_.run(view, rays, hits, structure));
    return;
  }

  structure.dispatches = dispatchesToLook_;
  int lookAhead = firstLookAhead_;
  store_.grid().apply(request_);
  request_.set("maxRequests", RunBuilder::kMaxRequests);
  structure.supply = [&](const auto& overWaiting) {
    request_.set("lookAhead", lookAhead);
    lookAhead = std::min(2 * lookAhead, kMaxLookAhead);
    overWaiting(request_);
    const auto scope = view.profiler.section("build");
    if (few_)
      builder_.buildFew(view.scene, store_);
    else
      builder_.buildRequested(view.scene, store_);
  };
  gl::Readback::Slice<shared::BrickWork> work;
  structure.copy = [&](gl::Readback& readback) { work = readback.copy<shared::BrickWork>(store_.work()); };
  structure.settle = [&](const gl::Readback& readback, bool done) {
    const auto scope = view.profiler.section("build");
    store_.follow(readback.values(work)[0]);
    few_ = few_ && !store_.tooMany();
    // Later generations of rays will ask for more.
    if (done && traces.count >= view.frame.traces) store_.fit(builder_.bytes(), kept_);
    return done || store_.makeRoom(builder_.bytes());
  };
  built_ = false;  // a build that fails half way leaves nothing to keep
  builder_.begin(store_);
  traces.dispatches.push_back(tracePass_.run(view, rays, hits, structure));
  built_ = true;
  builder_.releaseMemory();
}

TracerMemory IdentityTracer::memory() const {
  TracerMemory memory;
  store_.report(memory);
  builder_.addMemory(memory);
  memory.transient += tracePass_.bytes();
  return memory;
}

}  // namespace halfsilver
