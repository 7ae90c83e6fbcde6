#include "frame_record.h"

#include <algorithm>
#include <utility>

#include <halfsilver/error.h>

namespace halfsilver {

static_assert(kShadowRays == RAY_SHADOW && kRayKinds == RAY_THROUGH + 1);

std::size_t Frame::bytes() const {
  std::size_t sum =
      constants.bytes() + gbuffer.bytes() + effect.bytes() + hits.bytes() + lightRays.bytes() + tally.bytes();
  for (const RayBatch& batch : batches) sum += batch.bytes();
  for (const RayQueue& queue : queues) sum += queue.bytes();
  return sum;
}

void Frame::forgetRays() {
  effect = {};
  batches.clear();
  queues = {};
  hits = {};
  lightRays = {};
}

void FrameRecord::begin() {
  profiler_.discard();
  readback_.clear();
  known_ = {};
  memory_ = {};
  reported_ = false;
  firstCounts_.clear();
  laterCounts_.clear();
  signature_ = contributions_ = buildCounts_ = primaryCounts_ = {};
  addBuildCounts_ = nullptr;
}

void FrameRecord::end(const Frame& frame, const Tracer* tracer, const MemoryReport& held,
                      std::vector<std::string> warnings) {
  known_.pixels = static_cast<std::uint64_t>(frame.gbuffer.width) * static_cast<std::uint64_t>(frame.gbuffer.height);
  known_.minDistance = frame.host.minDistance;
  known_.warnings = std::move(warnings);
  known_.memory = held;
  known_.memory.gbuffer = frame.gbuffer.bytes();
  number_ = frame.gbuffer.number;
  signature_ = readback_.copy<std::uint32_t>(frame.gbuffer.signature);
  if (frame.gbuffer.primaryCounts) primaryCounts_ = readback_.copy<std::uint32_t>(frame.gbuffer.primaryCounts, 2);
  // Rays that nobody traces are no selection: the layers say so too.
  if (tracer) {
    memory_ = tracer->memory();
    for (const RayBatch& batch : frame.batches)
      firstCounts_.push_back(readback_.copy<shared::RayCount>(batch.rays.count));
    for (const auto* queues : {&frame.queues, &frame.lightRays.queues})
      for (const RayQueue& queue : *queues)
        if (queue.count) laterCounts_.push_back(readback_.copy<shared::RayCount>(queue.count));
    for (const RayBatch* batch : {&frame.effect.seen, &frame.effect.behind})
      if (batch->rays.count) laterCounts_.push_back(readback_.copy<shared::RayCount>(batch->rays.count));
    if (frame.effect.contributions.counts)
      contributions_ = readback_.copy<std::uint32_t>(frame.effect.contributions.counts, CONTRIBUTION_CLASSES);
    raysPerPixel_ = std::max(frame.host.glossySamples, 1u);
    known_.passes = frame.passes.summed + frame.passes.count;
    const TracerCounts counts = tracer->counts();
    if (counts.buffer) {
      buildCounts_ = readback_.copy<std::uint32_t>(*counts.buffer, counts.buffer->bytes() / sizeof(std::uint32_t));
      addBuildCounts_ = counts.add;
    }
  }
  readback_.submit();
}

FrameReport FrameRecord::report() {
  if (reported_) return known_;
  if (!readback_.ready()) readback_.wait();
  if (readback_.values(signature_)[0] != number_)
    throw Error(ErrorKind::failed, "the device has not run the frame: what its shaders were to write is not there");
  for (const gl::SectionTime& time : profiler_.collect()) known_.times.push_back({time.name, time.milliseconds});
  for (const auto& slice : laterCounts_) {
    const shared::RayCount& later = readback_.values(slice)[0];
    known_.overflow += later.overflow;
    for (std::size_t kind = 0; kind < known_.rays.size(); ++kind) known_.rays[kind] += later.byKind[kind];
  }
  for (const auto& slice : firstCounts_) {
    const shared::RayCount& first = readback_.values(slice)[0];
    known_.overflow += first.overflow;
    known_.selected += (first.count - first.byKind[RAY_THROUGH]) / raysPerPixel_;  // others go on behind surfaces
    known_.reflecting += first.reflecting;
    if (first.source == RAYS_OF_PIXELS) known_.rays[RAY_REFLECTION] += first.count - first.byKind[RAY_THROUGH];
    for (std::size_t kind = 0; kind < known_.rays.size(); ++kind) known_.rays[kind] += first.byKind[kind];
  }
  if (primaryCounts_.count) {
    known_.resampled = readback_.values(primaryCounts_)[0];
    known_.interpolated = readback_.values(primaryCounts_)[1];
  }
  if (contributions_.count) {
    const std::span<const std::uint32_t> classes = readback_.values(contributions_);
    known_.contributions.assign(classes.begin(), classes.end());
  }
  if (addBuildCounts_) addBuildCounts_(readback_.values(buildCounts_), memory_);

  MemoryReport& memory = known_.memory;
  memory.voxels = memory_.voxels;
  for (int axis = 0; axis < 3; ++axis) memory.grid[axis] = memory_.grid[axis];
  memory.heads = memory_.heads;
  memory.poolReserved = memory_.poolReserved;
  memory.poolUsed = memory_.poolUsed;
  memory.fragments = memory_.fragments;
  memory.fragmentsStored = memory_.fragmentsStored;
  std::copy(std::begin(memory_.perAxis), std::end(memory_.perAxis), std::begin(memory.fragmentsPerAxis));
  memory.bytesPerFragment = memory_.bytesPerFragment;
  memory.structureTotal = memory_.structureTotal;
  memory.transient = memory_.transient;
  memory.peak += memory_.structureTotal + memory_.transient;
  known_.lostFragments = memory_.lostFragments;
  reported_ = true;
  return known_;
}

}  // namespace halfsilver
