#pragma once

#include <optional>
#include <string>

#include "apps/demo/frame_log.h"
#include "apps/demo/game/frame_controller.h"
#include "apps/demo/options.h"

namespace halfsilver::demo {

// Keeps Options::frameTime with a controller, which starts over if the player changes it.
class FrameHolder {
 public:
  // How to draw the next frame: at this share of the resolution and with these options.
  double scale(const Options& options);
  Options options(const Options& chosen);
  // After the frame; its wall time includes all that the frame made necessary.
  void learn(const FrameFigures& figures);
  std::string say() const { return controller_ ? controller_->say() : std::string(); }

 private:
  const FrameQuality& quality(const Options& options);

  std::optional<FrameController> controller_;
  FrameQuality full_;
};

}  // namespace halfsilver::demo
