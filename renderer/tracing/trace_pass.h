#pragma once

#include <span>

#include "frame/products.h"
#include "gl/profiler.h"
#include "gl/program.h"
#include "settings.h"

namespace halfsilver {

// Runs a method's traceRay() over a queue, as a compute shader or as fragments; both give the same bits.
class TracePass {
 public:
  TracePass(const gl::Api& api, TraceStage stage, std::span<const gl::Define> defines);

  // For the method's own uniforms.
  const gl::Program& program() const { return program_; }

  // Section "trace". The method has bound its structure. Ends with the hits readable by shaders.
  void run(const RayQueue& rays, const Hits& hits, gl::Profiler& profiler) const;

 private:
  void dispatch(const RayQueue& rays) const;

  const gl::Api* api_;
  TraceStage stage_;
  gl::Program program_;
  gl::EmptyVertexArray vertexArray_;
};

}  // namespace halfsilver
