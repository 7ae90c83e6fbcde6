#include <algorithm>
#include <limits>

#include "renderer_impl.h"

// How rays go through a frame: batches of first ones, their generations, and what lies behind clear surfaces.
namespace halfsilver {

// Of a batch: what belongs to its rays fits one storage block each.
std::uint32_t Renderer::Impl::maxRays(const Settings& wanted, const shared::FrameConstants& frame) const {
  static_assert(sizeof(shared::Radiance) <= sizeof(shared::Hit) && sizeof(shared::PausedRay) <= sizeof(shared::Hit));
  std::size_t bytes = sizeof(shared::Hit);
  if (tracer->storesAttributes()) bytes = std::max(bytes, sizeof(shared::HitSurface));
  if (effect->generations(wanted, frame) > 1 || effect->storesFirstRays(wanted))
    bytes = std::max({bytes, sizeof(shared::Ray), sizeof(shared::RayPath)});
  const std::uint64_t most = lightsByRays(wanted) ? LightRays::kRaysAtOnce : std::numeric_limits<std::uint32_t>::max();
  return static_cast<std::uint32_t>(std::min(static_cast<std::uint64_t>(api.limits.storageBlockBytes) / bytes, most));
}

// The first rays of a batch, on their way.
void Renderer::Impl::submitBatch(const FrameView& view, Frame& frame, std::size_t number) {
  RayBatch& batch = frame.batches[number];
  effect->spawn(view, static_cast<int>(number), static_cast<int>(frame.batches.size()), batch.rays, frame.effect);
  reserveHits(api, batch.rays, tracer->storesAttributes() && !effect->startsAtCamera(), batch.hits);
  if (effect->startsAtCamera())
    effect->firstHits(view, batch.rays, batch.hits);
  else
    tracer->submit(view, batch.rays, batch.hits);
}

// The hits of a batch and of all generations after it, into the picture.
void Renderer::Impl::finishBatch(const FrameView& view, Frame& frame, std::size_t number) {
  RayBatch& batch = frame.batches[number];
  effect->measure(view, batch.rays, frame.effect);
  if (!effect->startsAtCamera()) {
    tracer->collect(view, batch.rays, batch.hits);
    if (frame.tally.any()) tallyPass.add(view, batch.rays, batch.hits, false, frame.tally);
  }
  for (std::uint32_t pass = 0; pass < frame.passes.count; ++pass)
    runPass(view, frame, batch,
            {.pass = frame.passes.first + pass,
             .begins = frame.passes.summed + pass == 0,
             .batch = static_cast<int>(number)});
  effect->resolve(view, frame.settings, batch.rays, frame.passes, static_cast<int>(number), frame.effect,
                  frame.gbuffer);
}

// What lies behind clear surfaces becomes part of the shaded picture.
void Renderer::Impl::seeThrough(const FrameView& view, Frame& frame) {
  RayBatch& batch = frame.effect.behind;
  const auto batches = static_cast<int>(frame.batches.size());
  for (int number = 0; number < batches; ++number) {
    effect->spawnBehind(view, number, batches, batch.rays, frame.effect);
    tracing(view, frame)(batch.rays, batch.hits, false);
    runPass(view, frame, batch, {.pass = frame.passes.first, .batch = number});
    effect->resolveBehind(view, batch.rays, number, frame.effect, frame.gbuffer);
  }
}

// All generations of a batch.
void Renderer::Impl::runPass(const FrameView& view, Frame& frame, RayBatch& batch, RayStep step) {
  const int generations = effect->generations(frame.settings, frame.host);
  const bool byRays = lightsByRays(frame.settings);
  const LightRays::Trace trace = tracing(view, frame);
  for (int generation = 0; generation < generations; ++generation) {
    step.generation = generation;
    const bool last = generation + 1 == generations;
    const RayQueue& rays = generation == 0 ? batch.rays : frame.queues[static_cast<std::size_t>((generation - 1) % 2)];
    RayQueue& next = frame.queues[static_cast<std::size_t>(generation % 2)];
    Hits& hits = generation == 0 ? batch.hits : frame.hits;
    if (generation > 0) trace(rays, hits, effect->asksForAnyHit(generation, frame.host));
    effect->shade(view, frame.settings, rays, hits, step, last ? nullptr : &next, frame.effect);
    if (byRays) lightRays.lightHits(view, lights, trace, rays, hits, step, !last, frame.effect, frame.lightRays);
  }
}

}  // namespace halfsilver
