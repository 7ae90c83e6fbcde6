#pragma once

#include <functional>
#include <string>
#include <vector>

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
  // `folder` below shaders/: holds trace.comp and trace.frag of the method. `defines` are the method's own.
  TracePass(const gl::Api& api, const TraceSettings& settings, const std::string& folder,
            std::vector<gl::Define> defines = {});

  // For the method's own uniforms.
  const gl::Program& program() const { return program_; }
  // That rays need beside the queue.
  std::uint64_t bytes() const { return paused_.bytes() + work_.bytes() + resumeWork_.bytes(); }
  // RayWork per ray of the last queue, if it is counted (trace.count_work).
  const gl::Buffer* work() const { return work_ ? &work_ : nullptr; }

  // What the method adds.
  struct Structure {
    // Binds all that its search reads; called before every dispatch.
    std::function<void()> bind;
    // Called between two dispatches: has the GPU make what rays wait for, nothing if none do. What it is called with
    // runs a program of TRACE_GROUP invocations per group over the rays that wait. Empty if rays never wait.
    std::function<void(const std::function<void(const gl::Program&)>& overWaiting)> supply = {};
    // Called where the host looks how far the rays are: what it needs to know besides is copied, and settled once it
    // has arrived. `done`: all rays are through. False: nothing more comes, and what the next dispatch leaves is
    // overflow.
    std::function<void(gl::Readback&)> copy = {};
    std::function<bool(const gl::Readback&, bool done)> settle = {};
    // Dispatches before the host looks, twice as many each time; those that find all rays done do nothing. With
    // `certain` it never looks, and what the last one leaves is overflow.
    int dispatches = 1;
    bool certain = false;
  };

  // Section "trace". Ends with the hits readable by shaders. If rays never wait and the driver lets loops run, one
  // dispatch does it all and the host waits for nothing. Returns how many dispatches there have been work for.
  int run(const FrameView& view, const RayQueue& rays, const Hits& hits, const Structure& structure);

 private:
  void bind(const FrameView& view, const RayQueue& rays, const Hits& hits) const;
  void dispatchWaiting() const;
  void dispatch(const RayQueue& rays, bool resuming) const;
  void dispatchFragments(const RayQueue& rays, bool resuming) const;
  void prepareResume(const FrameView& view, const RayQueue& rays) const;

  const gl::Api* api_;
  TraceSettings settings_;
  gl::Program program_, resume_;
  gl::EmptyVertexArray vertexArray_;
  gl::Buffer paused_;      // PausedRay[capacity of the largest queue]
  gl::Buffer work_;        // RayWork, likewise; empty unless it is counted
  gl::Buffer resumeWork_;  // Resume, two lists of rays
  gl::Readback look_;
};

}  // namespace halfsilver
