#include <chrono>

#include <halfsilver/context.h>
#include <halfsilver/gl/api.h>
#include "apps/demo/outputs.h"
#include "apps/demo/overlay.h"
#include "apps/demo/session.h"
#include "apps/demo/start.h"
#include "apps/demo/viewer.h"
#include "apps/drawing.h"
#include "apps/progress.h"

namespace halfsilver::demo {
namespace {

constexpr double kStep = 1.0 / 30;  // seconds per frame
constexpr int kLayouts = 3;         // until panels know their sizes

}  // namespace

void runHeadless(const Request& request) {
  const Size size = parseSize(request.view.size);
  Options options = firstOptions(request);
  RunOutputs outputs(request);
  Progress progress;
  progress.show("loading");
  std::unique_ptr<Play> play = makePlay(request);
  const Context context = makeContext(contextKind(request.view.context));
  const gl::Api api = gl::Api::load(context.getProcAddress());
  Session session(api, context.getProcAddress(), request.view.threads);
  session.play(std::move(play), size, options);
  std::optional<Overlay> overlay;
  std::optional<OffscreenTarget> shown;
  if (request.overlay) {
    overlay.emplace(nullptr, request.contentScale.value_or(1));
    shown.emplace(api, size);
  }
  FrameLog log;
  for (int frame = 0; frame < *request.frames; ++frame) {
    progress.show("frame " + std::to_string(frame + 1) + " of " + std::to_string(*request.frames));
    session.advance({}, kStep);
    const FrameFigures figures = session.draw(size, 1, options, true);
    log.add(figures);
    outputs.add(figures);
    if (!overlay || frame + 1 < *request.frames) continue;
    const std::vector<Segment> cells = session.cells(options);
    OverlayState state{options,
                       log,
                       session.playing().model(),
                       dynamic_cast<Viewer*>(&session.playing()),
                       {},
                       {},
                       {},
                       session.status(options),
                       cells};
    for (int i = 0; i < kLayouts; ++i) overlay->layOut(size, kStep, session.backdrops(), state);
    api.BindFramebuffer(GL_DRAW_FRAMEBUFFER, shown->target().framebuffer);
    overlay->draw();
  }
  progress.clear();
  outputs.commit(size, shown ? shown->read() : session.read());
}

}  // namespace halfsilver::demo
