#pragma once

#include <glm/glm.hpp>

namespace halfsilver {

// How a picture takes part in the depth test of its target, in window depths of glDepthRange(0, 1). With a test, each
// pixel is drawn where it is not behind what is there, and leaves the depth of its surface; the sky lies at the far
// plane. A target without a depth attachment is drawn as with none.
enum class DepthUse {
  none,      // the picture covers all and leaves depth as it is
  standard,  // 0 at the near plane, 1 far away: GL's initial clip space (-1 to 1) and GL_LESS, cleared to 1
  reversed   // 1 at the near plane, 0 far away: glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE) and GL_GREATER, cleared to
             // 0; with a float attachment precise at every distance
};

// A rectangle of a framebuffer that the caller owns (0: the default framebuffer). Row 0 is the bottom, as in GL.
struct Target {
  unsigned framebuffer = 0;
  int x = 0, y = 0;
  int width = 0, height = 0;
  DepthUse depth = DepthUse::none;
};

// Clip coordinates are projection * view * (position, 1); view space is GL's: x right, y up, looking down -z, meters.
struct CameraMatrices {
  glm::mat4 view{1}, projection{1};
};

}  // namespace halfsilver
