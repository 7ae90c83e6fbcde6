#include "picture.h"

#include <algorithm>
#include <utility>

#include "frame/frame_constants.h"

namespace halfsilver {
namespace {

// Frames until a still mean begins: half of what a moving one holds, so that a view soon comes to rest.
constexpr int kSettling = 8;

// Settings without those that change how radiance is shown and not radiance itself.
Settings ofRadiance(Settings settings) {
  settings.image = {};
  settings.effect.passes = 1;  // how many come at once is no matter
  return settings;
}

// Without those that a controller may turn from frame to frame as well.
Settings ofHistory(Settings settings) {
  settings.select.fraction = 1;
  settings.select.minContribution = 0;
  return settings;
}

}  // namespace

PictureUse Picture::begin(const Camera& camera, const Settings& settings, const glm::ivec2& size,
                          const std::optional<std::uint32_t>& sample) {
  View view{{ofRadiance(settings), size}, camera};
  const auto passes = static_cast<std::uint32_t>(settings.effect.passes);
  if (sample) {
    history_.reset();
    refined_.reset();
    const bool first = samplesOf_ != view;
    samplesOf_ = std::move(view);
    return {.kind = PictureUse::Kind::sample,
            .first = first,
            .jitter = sampleOffset(*sample),
            .passes = {.first = *sample * passes, .count = passes}};
  }
  if (settings.image.antialiasing == Antialiasing::temporal) return beginTemporal(std::move(view), passes);
  history_.reset();  // motion is known from one frame to the next
  if (!settings.effect.progressive) {
    refined_.reset();
    return {.passes = {.count = passes}};
  }
  if (refined_ && refined_->view == view) {
    refined_->passes += passes;
  } else {
    refined_ = Refined{.view = std::move(view), .passes = passes};
  }
  const std::uint32_t before = refined_->passes - passes;
  return {.passes = {.first = before, .count = passes, .summed = before}};
}

PictureUse Picture::beginTemporal(View view, std::uint32_t passes) {
  refined_.reset();
  Subject subject{ofHistory(view.subject.settings), view.subject.size};
  PictureUse use{.kind = PictureUse::Kind::temporal};
  use.first = !history_ || history_->subject != subject;
  if (use.first) {
    history_ = History{.subject = std::move(subject), .last = {}};
  } else {
    const bool same = !history_->changed && history_->last == view;
    history_->unsettled = same ? std::max(0, history_->unsettled - 1) : kSettling;
    use.still = history_->unsettled == 0;
    if (history_->last.camera != view.camera) {
      const glm::dvec2 moved = history_->moved + meanMotion(history_->last.camera, view.camera, view.subject.size);
      history_->moved = moved - glm::floor(moved + 0.5);
    }
  }
  history_->changed = false;
  history_->last = std::move(view);
  use.passes = {.first = history_->frames * passes, .count = passes};
  // Samples move with the picture, so that those of several frames fill its pixels evenly.
  const glm::dvec2 jitter = glm::dvec2(sampleOffset(history_->frames++)) + history_->moved;
  use.jitter = jitter - glm::floor(jitter + 0.5);
  return use;
}

void Picture::changed() {
  samplesOf_.reset();
  refined_.reset();
  if (history_) history_->changed = true;
}

void Picture::forget() {
  samplesOf_.reset();
  refined_.reset();
  history_.reset();
}

void Picture::show(const FrameView& view, const Frame& frame, const gl::Buffer& previousPositions,
                   const Target& target) {
  const bool fxaa =
      frame.use.kind == PictureUse::Kind::frame && frame.settings.image.antialiasing == Antialiasing::fxaa;
  if (!fxaa) fxaa_.forget();
  if (frame.use.kind == PictureUse::Kind::sample) {
    if (frame.use.first) samples_.samples = 0;
    accumulate_.run(view, samples_);
    display_.run(view, meanOfSamples(), DisplayPass::Output::display, target);
    return;
  }
  if (frame.use.kind == PictureUse::Kind::temporal) {
    using Past = TemporalPass::Past;
    temporal_.begin(view);
    if (previousPositions && frame.host.allLight == 0 &&
        frame.host.glossySamples == 0)  // none if a frame of another kind has begun since
      for (const RayBatch& batch : frame.batches) temporal_.follow(view, batch, previousPositions);
    temporal_.run(view, frame.use.first ? Past::none : frame.use.still ? Past::still : Past::moving);
    display_.run(view, {temporal_.picture()}, DisplayPass::Output::display, target);
    return;
  }
  temporal_.forget();
  if (fxaa) {
    composite_.run(view, CompositePass::Output::undithered, fxaa_.source(target.width, target.height));
    fxaa_.run(view, target);
    return;
  }
  composite_.run(view, CompositePass::Output::display, target);
}

void Picture::readLinear(const FrameView& view, const Frame& frame, GLuint framebuffer) {
  const Target target{framebuffer, 0, 0, frame.gbuffer.width, frame.gbuffer.height};
  if (frame.use.kind == PictureUse::Kind::frame)
    composite_.run(view, CompositePass::Output::linear, target);
  else
    display_.run(
        view, frame.use.kind == PictureUse::Kind::sample ? meanOfSamples() : DisplayPass::Source{temporal_.picture()},
        DisplayPass::Output::linear, target);
}

}  // namespace halfsilver
