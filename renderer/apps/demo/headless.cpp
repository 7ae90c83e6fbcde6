#include <chrono>
#include <iostream>

#include <halfsilver/context.h>
#include <halfsilver/gl/api.h>
#include "apps/demo/frame_holder.h"
#include "apps/demo/outputs.h"
#include "apps/demo/overlay.h"
#include "apps/demo/session.h"
#include "apps/demo/start.h"
#include "apps/demo/viewer.h"
#include "apps/drawing.h"
#include "apps/progress.h"

namespace halfsilver::demo {
namespace {

constexpr int kLayouts = 3;  // until panels know their sizes

}  // namespace

void runHeadless(const Request& request) {
  const Size size = parseSize(request.view.size);
  Options options = firstOptions(request);
  RunOutputs outputs(request);
  const double step = 1.0 / request.fps;  // seconds per frame
  Progress progress;
  progress.show("loading");
  std::unique_ptr<Play> play = makePlay(request);
  std::vector<std::string> warnings;
  const Context context = openContext(request.view.context, request.view.device, warnings);
  for (const std::string& warning : warnings) std::cerr << "warning: " << warning << '\n';
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
  FrameHolder holder;
  for (int frame = 0; frame < *request.frames; ++frame) {
    progress.show("frame " + std::to_string(frame + 1) + " of " + std::to_string(*request.frames));
    const auto start = std::chrono::steady_clock::now();
    session.advance({}, step);
    FrameFigures figures = session.draw(size, holder.scale(options), holder.options(options), true);
    figures.wallMilliseconds = millisecondsSince(start);
    holder.learn(figures);
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
                       holder.say(),
                       session.status(options),
                       cells};
    for (int i = 0; i < kLayouts; ++i) overlay->layOut(size, step, session.backdrops(), state);
    api.BindFramebuffer(GL_DRAW_FRAMEBUFFER, shown->target().framebuffer);
    overlay->draw();
  }
  progress.clear();
  session.playing().finish();
  outputs.commit(shown ? size : session.view().size(), shown ? shown->read() : session.read());
}

}  // namespace halfsilver::demo
