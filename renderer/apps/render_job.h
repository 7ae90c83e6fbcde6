#pragma once

#include <functional>
#include <string>
#include <vector>

#include <halfsilver/context.h>
#include <halfsilver/renderer.h>
#include "apps/offscreen.h"
#include "apps/progress.h"
#include "apps/statistics.h"
#include "apps/view_request.h"
#include "apps/wall_clock.h"

namespace halfsilver {

// All that drawing a scene without a window takes: the view, a context, a target and a renderer that holds the scene.
struct RenderJob {
  // Loads and uploads. Throws Error: badInput, noContext.
  RenderJob(const ViewRequest& request, const ViewArguments& arguments, Settings settings, PosedView loaded,
            Progress& progress, WallClock& clock);
  RenderJob(const RenderJob&) = delete;

  PosedView view;
  RunStatistics statistics;
  Context context;
  gl::Api api;
  OffscreenTarget target;
  Renderer renderer;
};

// Draws a frame and sets the exposure that suits it.
void exposeFor(RenderJob& job, const Camera& camera, Settings& settings);

// If trace.method is auto, chooses the method that suits scene and device, or remembers it. `advance`: see
// CalibrationInputs.
void decideMethod(RenderJob& job, const Camera& camera, Settings& settings,
                  const std::function<void(int)>& advance = {});

// Adds what the report says was lost.
void warnOfLosses(const FrameReport& report, std::vector<std::string>& warnings);

}  // namespace halfsilver
