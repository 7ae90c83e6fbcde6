#pragma once

#include <glm/glm.hpp>
#include <vector>

#include <halfsilver/frame_view.h>
#include "gl/program.h"

namespace halfsilver {

// Row by row from the bottom.
struct Surfaces {
  std::vector<glm::vec4> positions;  // xyz, w meters along the view axis; 0 where there is none
  std::vector<glm::vec4> normals;    // shading normal, w reflectivity or -alpha; 0 where there is none
};

// What the pixels of a G-buffer show, for the host. Move-only.
class SurfaceReader {
 public:
  explicit SurfaceReader(const gl::Api& api);

  // Of all pixels, or of a rectangle of them. Waits for the GPU.
  Surfaces read(const FrameView& view) const { return read(view, 0, 0, view.gbuffer.width, view.gbuffer.height); }
  Surfaces read(const FrameView& view, int x, int y, int width, int height) const;

 private:
  const gl::Api* api_;
  gl::Program program_;
};

// All texels of a texture of four channels.
std::vector<glm::vec4> readTexels(const gl::Texture& texture);

}  // namespace halfsilver
