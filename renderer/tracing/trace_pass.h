#pragma once

#include <functional>
#include <span>

#include <halfsilver/frame_view.h>
#include <halfsilver/settings.h>
#include "gl/framebuffer.h"
#include "gl/program.h"

namespace halfsilver {

// Runs a method's traceRay() over a queue, as a compute shader or as fragments; both give the same bits.
class TracePass {
 public:
  TracePass(const gl::Api& api, TraceStage stage, std::span<const gl::Define> defines);

  // For the method's own uniforms.
  const gl::Program& program() const { return program_; }

  // Called with rays left unfinished, between two dispatches; makes what they wait for and binds all of the method's
  // structure anew. False: nothing more comes, what the next dispatch leaves is overflow.
  using Supply = std::function<bool()>;

  // Section "trace". The method has bound its structure. Ends with the hits readable by shaders. Without `supply` and
  // where the driver lets loops run, one dispatch does it all and nothing waits for the GPU.
  void run(const FrameView& view, const RayQueue& rays, const Hits& hits, const Supply& supply = {});

 private:
  void bind(const FrameView& view, const RayQueue& rays, const Hits& hits) const;
  void dispatch(const RayQueue& rays) const;

  const gl::Api* api_;
  TraceStage stage_;
  gl::Program program_;
  gl::EmptyVertexArray vertexArray_;
  gl::Buffer paused_;  // PausedRay[capacity of the largest queue]
};

}  // namespace halfsilver
