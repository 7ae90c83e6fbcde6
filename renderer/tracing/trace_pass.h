#pragma once

#include <functional>
#include <span>
#include <string>

#include <halfsilver/frame_view.h>
#include <halfsilver/gl/readback.h>
#include <halfsilver/settings.h>
#include "gl/framebuffer.h"
#include "gl/program.h"

namespace halfsilver {

// Runs a method's traceRay() over a queue, as a compute shader or as fragments; both give the same bits. In one
// dispatch, or in several if rays wait for something or the driver's loops end.
class TracePass {
 public:
  // `folder` below shaders/: holds trace.comp and trace.frag of the method.
  TracePass(const gl::Api& api, TraceStage stage, const std::string& folder, std::span<const gl::Define> defines);

  // For the method's own uniforms.
  const gl::Program& program() const { return program_; }
  std::uint64_t bytes() const { return paused_.bytes(); }  // of rays that pause between dispatches

  // What the method adds.
  struct Structure {
    // Binds all that its search reads; called before every dispatch.
    std::function<void()> bind;
    // Called between two dispatches if rays are unfinished; makes what they wait for. False: nothing more comes, and
    // what the next dispatch leaves is overflow. Empty if rays never wait.
    std::function<bool()> supply = {};
  };

  // Section "trace". Ends with the hits readable by shaders. If rays never wait and the driver lets loops run, one
  // dispatch does it all and the host waits for nothing.
  void run(const FrameView& view, const RayQueue& rays, const Hits& hits, const Structure& structure);

 private:
  void bind(const FrameView& view, const RayQueue& rays, const Hits& hits) const;
  void dispatch(const RayQueue& rays) const;

  const gl::Api* api_;
  TraceStage stage_;
  gl::Program program_;
  gl::EmptyVertexArray vertexArray_;
  gl::Buffer paused_;  // PausedRay[capacity of the largest queue]
  gl::BlockingRead read_;
};

}  // namespace halfsilver
