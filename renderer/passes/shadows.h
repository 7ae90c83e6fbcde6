#pragma once

#include <span>
#include <string>
#include <vector>

#include <halfsilver/gl/profiler.h>
#include <halfsilver/products.h>
#include <halfsilver/scene.h>
#include <halfsilver/settings.h>
#include "gl/framebuffer.h"
#include "gl/program.h"
#include "passes/shadow_boxes.h"
#include "passes/view_culling.h"

namespace halfsilver {

// What happened to the scene since the maps were drawn.
struct ShadowChange {
  static constexpr std::size_t kMaxMoved = 1024;

  bool everything = true;     // any triangle may cast another shadow
  std::vector<Bounds> moved;  // boxes that triangles have left or come into

  // Adds to `moved`; more than kMaxMoved become one box around them all.
  void add(std::span<const Bounds> boxes);
};

// Draws the shadow maps of all lights and of the sky's directions, section "shadow".
//
// One depth array with hardware comparison holds all maps (see light_list.h for who gets which part). Both faces of
// all triangles cast shadows, whatever the camera may see; shaders compare against the receiver's plane
// (lib/shadow_maps.glsl), so the maps need no depth offset. A view draws only clusters of triangles that it may see.
// Once drawn it is drawn again where something has moved, and as a whole only if it is another view than before.
class ShadowPass {
 public:
  explicit ShadowPass(const gl::Api& api);

  // Texels along a map on this device.
  int resolutionOf(const ShadowSettings& settings) const;

  // Brings `out` up to date with scene, lights, sky, the shadow settings and the boxes. Returns warnings, one line
  // each: lights or directions of the sky for which there was no room, or a resolution beyond the device.
  std::vector<std::string> run(const GpuScene& scene, std::span<const Light> lights, const Sky& sky,
                               const ShadowSettings& settings, const ShadowBoxes& boxes, const ShadowChange& change,
                               ShadowMaps& out, gl::Profiler& profiler) const;

 private:
  // A view with the parts of it that are out of date, in texels of its layer.
  struct Outdated {
    const ShadowView* view;
    std::vector<glm::ivec4> rectangles;
  };
  void follow(const GpuScene& scene, std::span<const ShadowView> views, const ShadowChange& change,
              std::span<const ShadowView> drawn, ShadowMaps& out) const;
  void redraw(const GpuScene& scene, const Outdated& part, Casters casters, const gl::Framebuffer& framebuffer,
              const gl::Texture& maps, ShadowMaps& out) const;
  void addMoving(const GpuScene& scene, const Outdated& part, const gl::Framebuffer& framebuffer,
                 ShadowMaps& out) const;
  void begin(const ShadowView& view, const gl::Framebuffer& framebuffer, const gl::Texture& maps) const;
  void draw(const GpuScene& scene, const ShadowView& view, const VisibleRuns& runs, ShadowMaps& out) const;
  void drawOpaque(const GpuScene& scene, const ShadowView& view, const VertexRuns& runs) const;
  void drawCut(const GpuScene& scene, const ShadowView& view, const VertexRuns& runs) const;

  const gl::Api* api_;
  gl::Program opaque_, cut_;
  gl::EmptyVertexArray vertexArray_;
};

}  // namespace halfsilver
