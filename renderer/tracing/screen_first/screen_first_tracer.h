#pragma once

#include <map>
#include <memory>

#include <halfsilver/settings.h>
#include <halfsilver/tracer.h>
#include "tracing/depth_pyramid.h"
#include "tracing/grid.h"
#include "tracing/screen_first/back_faces.h"
#include "tracing/trace_pass.h"

namespace halfsilver {

// Rays that the screen answers with certainty never reach the structure, which is another method's: fewer rays, and a
// structure that is built on demand for fewer places. What is certain stands in
// shaders/tracing/screen_first/search.glsl. Hits of the others are those of the structure's method to the bit.
class ScreenFirstTracer final : public Tracer {
 public:
  // The row of the table; `structure` is that of the method behind the screen.
  static Method method(const Method& structure);

  ScreenFirstTracer(const gl::Api& api, const Settings& settings, std::unique_ptr<Tracer> structure);

  // Section "build" has the pyramid, too.
  void update(const FrameView& view, const SceneChange& change) override;
  void forget() override { structure_->forget(); }
  void trace(const FrameView& view, const RayQueue& rays, Hits& hits) override;
  void occluded(const FrameView& view, const RayQueue& rays, Hits& hits) override;
  bool seesBehind() const override { return structure_->seesBehind(); }
  TracerMemory memory() const override;
  TracerCounts counts() const override { return structure_->counts(); }
  StructureCells cells() const override { return structure_->cells(); }
  const gl::Buffer* answers(const RayQueue& rays) const override;

 private:
  void askScreen(const FrameView& view, const RayQueue& rays, Hits& hits);
  gl::Buffer& reserve(const RayQueue& rays);
  void takeBack(const FrameView& view, const RayQueue& rays, const Hits& hits) const;

  const gl::Api* api_;
  std::unique_ptr<Tracer> structure_;
  DepthPyramid pyramid_;
  BackFaces backFaces_;
  TracePass tracePass_;
  gl::Program collect_, beginRest_, return_;
  Grid grid_;      // the bounds alone: rays begin and end there
  RayQueue rest_;  // without paths
  Hits restHits_;
  gl::Buffer restIndices_;                         // uint per ray of rest_: its place
  std::map<const RayQueue*, gl::Buffer> answers_;  // of queues of pixels, by where they lie
  gl::Buffer noAnswers_;
};

}  // namespace halfsilver
