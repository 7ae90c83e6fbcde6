#pragma once

#include <halfsilver/settings.h>
#include <halfsilver/tracer.h>
#include "gl/program.h"
#include "tracing/capture_draw.h"
#include "tracing/grid.h"
#include "tracing/per_frame.h"
#include "tracing/trace_pass.h"

namespace halfsilver {

// A planar reflection, as engines offer it: the scene is drawn once more from behind one plane, and the mirror shows
// that picture (McReynolds & Blythe 2005, "Advanced Graphics Programming Using OpenGL", chapter 17). Engines have the
// plane named by hand; here it is the one that most of the reflecting pixels lie in. All that the picture shows is
// exact, off-screen things as well; rays from anywhere else, or not as from an even mirror, miss.
class PlanarTracer final : public Tracer {
 public:
  static Method method();  // the row of the table

  PlanarTracer(const gl::Api& api, const Settings& settings);

  // Section "build": finds the plane and draws the mirrored scene.
  void update(const FrameView& view, const SceneChange& change) override;
  void trace(const FrameView& view, const RayQueue& rays, Hits& hits) override;
  bool seesBehind() const override { return false; }
  TracerMemory memory() const override;
  const gl::Buffer* rayWork() const override { return tracePass_.work(); }

 private:
  // Of a frame under way.
  struct Mirrored {
    gl::Buffer planes;  // MirrorPlanes
    gl::Texture image;  // as CaptureDraw has it, of the picture's size
  };
  void choosePlane(const FrameView& view, const gl::Buffer& planes) const;

  const gl::Api* api_;
  gl::Program choose_, settle_;
  CaptureDraw draw_;
  TracePass tracePass_;
  Grid grid_;  // the bounds alone: rays begin and end there
  gl::Texture depth_;
  PerFrame<Mirrored> frames_;
};

}  // namespace halfsilver
