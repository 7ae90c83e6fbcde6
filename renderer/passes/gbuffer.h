#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include <halfsilver/frame_view.h>
#include <halfsilver/settings.h>
#include "frame/surface_programs.h"
#include "gl/framebuffer.h"
#include "gl/program.h"

namespace halfsilver {

// Deferred geometry in two steps: rasterization stores which triangle a pixel sees, then a compute pass finds the
// exact point of that triangle on the pixel's ray and evaluates its material once per pixel (Burns & Hunt, "The
// Visibility Buffer: A Cache-Friendly Approach to Deferred Shading", JCGT 2013).
class GBufferPass {
 public:
  explicit GBufferPass(const gl::Api& api);

  // Section "gbuffer". Allocates `out` if its size is not the frame's. Pixels that `primary` leaves without a surface
  // have a position with w = -1.
  void run(const FrameView& view, GBuffer& out, const PrimarySettings& primary = {});

 private:
  void rasterize(const FrameView& view, const GBuffer& out) const;
  const gl::Program& resolving(const FrameView& view, const PrimarySettings& primary);
  void beginTests(const gl::Program& program, const PrimarySettings& primary, GBuffer& out) const;
  void resolve(const FrameView& view, GBuffer& out, const PrimarySettings& primary);

  const gl::Api* api_;
  gl::Program opaque_, cut_;
  // By the rules for what a pixel may show, of which the first are none; that is made at once, the others on first use.
  std::array<std::optional<SurfacePrograms>, 5> resolve_;
  gl::Framebuffer framebuffer_;
  gl::EmptyVertexArray vertexArray_;
  std::uint32_t frames_ = 0;  // that have been numbered
};

}  // namespace halfsilver
