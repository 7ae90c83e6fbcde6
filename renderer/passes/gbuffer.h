#pragma once

#include <halfsilver/gl/profiler.h>
#include <halfsilver/products.h>
#include "gl/framebuffer.h"
#include "gl/program.h"

namespace halfsilver {

// Deferred geometry in two steps: rasterization stores which triangle a pixel sees, then a compute pass finds the
// exact point of that triangle on the pixel's ray and evaluates its material once a pixel (Burns & Hunt, "The
// Visibility Buffer: A Cache-Friendly Approach to Deferred Shading", JCGT 2013).
class GBufferPass {
 public:
  explicit GBufferPass(const gl::Api& api);

  // Section "gbuffer". Allocates `out` anew where its size differs. The scene and UBO_FRAME are bound by the caller.
  void run(const GpuScene& scene, GBuffer& out, int width, int height, bool cullBackFaces, gl::Profiler& profiler);

 private:
  void rasterize(const GpuScene& scene, const GBuffer& out, bool cullBackFaces) const;
  void resolve(const GBuffer& out) const;

  const gl::Api* api_;
  gl::Program opaque_, cut_, resolve_;
  gl::Framebuffer framebuffer_;
  gl::EmptyVertexArray vertexArray_;
};

}  // namespace halfsilver
