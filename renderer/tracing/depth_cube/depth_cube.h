#pragma once

#include <string>

#include <halfsilver/frame_view.h>
#include <halfsilver/gl/readback.h>
#include <halfsilver/gl/texture.h>
#include <halfsilver/settings.h>
#include <halfsilver/tracer.h>
#include "gl/framebuffer.h"
#include "gl/program.h"
#include "tracing/build_counters.h"
#include "tracing/grid.h"

namespace halfsilver {

// Layered depth images along three axes, side by side in arrays of layers, with the range of depths of each block of
// texels as a second level; see shaders/shared/passes/depth_cube.h for what they hold.
//
// It is made by depth peeling: one draw counts the samples of each texel, the GPU finds the most, and so many draws
// follow, each of which keeps the nearest fragments behind those of the draw before. The host reads that one number,
// for the size of the arrays.
// Source: Buerger, Hertel, Krueger & Westermann 2007, sections 1.2 and 1.3; Everitt 2001 (depth peeling).
class DepthCube {
 public:
  DepthCube(const gl::Api& api, const Settings& settings);

  // Section "build". Throws Error (failed) if the device cannot draw images of that size.
  void build(const FrameView& view, const Grid& grid);

  // For programs that include tracing/depth_cube/cube.glsl, and all that their search reads.
  void apply(const gl::Program& program) const;
  void bind() const;

  int layers() const { return layers_; }
  // Texels have more samples than that.
  bool lost() const { return deepest_ > static_cast<std::uint32_t>(layers_); }

  void report(TracerMemory& memory) const;
  const BuildCounters& counters() const { return counters_; }
  static void addCounts(std::span<const std::uint32_t> counters, TracerMemory& memory);

 private:
  struct DrawPrograms {
    DrawPrograms(const gl::Api& api, const std::string& fragment);
    gl::Program opaque, cut;
  };
  gl::Texture makeImage(GLenum format, int layers, const char* label) const;
  void count(const FrameView& view, const Grid& grid);
  void allocate(int layers);
  void draw(const DrawPrograms& programs, const FrameView& view, const Grid& grid) const;
  void peel(const FrameView& view, const Grid& grid);
  void storeSurfaces(const FrameView& view, const Grid& grid);
  void boundBlocks(const Grid& grid);

  const gl::Api* api_;
  DepthCubeSettings settings_;
  int texels_, maxLayers_;
  DrawPrograms count_;
  gl::Program deepestCount_;
  DrawPrograms peel_;
  gl::Program storeSurfaces_, boundBlocks_;
  gl::EmptyVertexArray vertexArray_;
  BuildCounters counters_;
  gl::BlockingRead read_;
  std::uint32_t deepest_ = 0;  // most samples that a texel has
  int layers_ = 0;
  gl::Buffer sampleCounts_, blocks_;
  gl::Texture depths_, normals_, triangles_, colors_;
  std::uint64_t transient_ = 0;  // while it was built
};

}  // namespace halfsilver
