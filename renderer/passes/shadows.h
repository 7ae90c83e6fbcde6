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
// (lib/shadow_maps.glsl), so the maps need no depth offset. A view draws only clusters of triangles that it may see,
// and is drawn again only if it is another one or something moved in it.
class ShadowPass {
 public:
  explicit ShadowPass(const gl::Api& api);

  // Brings `out` up to date with scene, lights, sky and the shadow settings. Returns warnings, one line each: lights or
  // directions of the sky for which there was no room, or a resolution beyond the device.
  std::vector<std::string> run(const GpuScene& scene, std::span<const Light> lights, const Sky& sky,
                               const Settings& settings, const ShadowChange& change, ShadowMaps& out,
                               gl::Profiler& profiler) const;

 private:
  void draw(const GpuScene& scene, const ShadowView& view, const gl::Framebuffer& framebuffer, ShadowMaps& out) const;
  void drawOpaque(const GpuScene& scene, const ShadowView& view, ShadowMaps& out) const;
  void drawCut(const GpuScene& scene, const ShadowView& view, ShadowMaps& out) const;

  const gl::Api* api_;
  gl::Program opaque_, cut_;
  gl::EmptyVertexArray vertexArray_;
};

}  // namespace halfsilver
