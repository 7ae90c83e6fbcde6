#include "apps/demo/frame_holder.h"

#include <algorithm>

namespace halfsilver::demo {

const FrameQuality& FrameHolder::quality(const Options& options) {
  if (options.frameTime <= 0)
    controller_.reset();
  else if (!controller_ || controller_->target() != options.frameTime)
    controller_.emplace(options.frameTime);
  return controller_ ? controller_->quality() : full_;
}

double FrameHolder::scale(const Options& options) { return quality(options).scale; }

Options FrameHolder::options(const Options& chosen) {
  Options held = chosen;
  held.settings.select.fraction *= static_cast<float>(quality(chosen).share);
  return held;
}

void FrameHolder::learn(const FrameFigures& figures) {
  if (!controller_) return;
  // The device may still be at work when the call that asked for it has returned.
  double milliseconds = figures.wallMilliseconds;
  for (const StageTime& time : figures.report.times)
    if (time.stage == "frame") milliseconds = std::max(milliseconds, time.milliseconds);
  controller_->learn(milliseconds);
}

}  // namespace halfsilver::demo
