#pragma once

#include <halfsilver/settings.h>
#include <halfsilver/tracer.h>
#include "gl/program.h"
#include "tracing/capture_draw.h"
#include "tracing/grid.h"
#include "tracing/per_frame.h"
#include "tracing/trace_pass.h"

namespace halfsilver {

// A cube of the scene around one point, looked up by direction (Greene 1986, "Environment Mapping and Other
// Applications of World Projections"), with the parallax of a box (Lagarde & Zanuttini 2012, "Local Image-based
// Lighting With Parallax-corrected Cubemap"): what engines call a reflection probe. Engines place probes by hand; here
// one stands before the middle of the reflecting surfaces that the camera sees, and is captured in every frame.
class CubemapTracer final : public Tracer {
 public:
  static Method method();  // the row of the table

  CubemapTracer(const gl::Api& api, const Settings& settings);

  // Section "build": places the probe and draws the faces.
  void update(const FrameView& view, const SceneChange& change) override;
  void trace(const FrameView& view, const RayQueue& rays, Hits& hits) override;
  bool seesBehind() const override { return false; }
  TracerMemory memory() const override;
  const gl::Buffer* rayWork() const override { return tracePass_.work(); }

 private:
  // Of a frame under way.
  struct Cube {
    gl::Buffer probe;   // vec4
    gl::Texture faces;  // as CaptureDraw has it, six layers
  };
  void placeProbe(const FrameView& view, const gl::Buffer& probe) const;

  const gl::Api* api_;
  int resolution_;  // texels along each side
  gl::Program place_;
  CaptureDraw draw_;
  TracePass tracePass_;
  Grid grid_;  // the bounds: the box
  gl::Texture depth_;
  PerFrame<Cube> frames_;
};

}  // namespace halfsilver
