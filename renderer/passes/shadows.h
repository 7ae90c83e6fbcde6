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

// Draws the shadow maps of all lights and of the sky's directions, section "shadow". It keeps nothing about what has
// changed: call it when scene, lights, sky or the shadow settings have.
//
// One depth array with hardware comparison holds all maps (see light_list.h for who gets which part). Both faces of
// all triangles cast shadows, whatever the camera may see; shaders compare against the receiver's plane
// (lib/lights.glsl), so the maps need no depth offset.
class ShadowPass {
 public:
  explicit ShadowPass(const gl::Api& api);

  // Replaces `out`. Returns warnings, one line each: lights or directions of the sky
  // for which there was no room, or a resolution beyond the device.
  std::vector<std::string> run(const GpuScene& scene, std::span<const Light> lights, const Sky& sky,
                               const Settings& settings, ShadowMaps& out, gl::Profiler& profiler) const;

 private:
  const gl::Api* api_;
  gl::Program opaque_, cut_;
  gl::EmptyVertexArray vertexArray_;
};

}  // namespace halfsilver
