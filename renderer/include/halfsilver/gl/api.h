#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <halfsilver/gl/functions.h>

// The project's own table of GL functions. It is filled through the current context's getProcAddress, so the same code
// runs on EGL, OSMesa and GLFW; there is no global loader. Objects keep a pointer to the table: it must outlive them.
namespace halfsilver::gl {

using Proc = void (*)();
using GetProcAddress = std::function<Proc(const char* name)>;

struct LinkedProgram;

// How programs came about.
struct ProgramCounts {
  std::uint64_t compiled = 0;  // from their sources
  std::uint64_t cached = 0;    // from what an earlier start has kept, see gl/program_cache.h
};

// The largest buffer of those that shaders read.
struct LargestBuffer {
  std::size_t bytes = 0;
  std::string label;
};

// What the device offers. Programs are checked against the storage blocks at link time (see gl/program.h).
struct Limits {
  GLint64 storageBlockBytes = 0;  // one shader storage block
  GLint64 bufferTexels = 0;       // one buffer texture
  GLint textureSize = 0;
  GLint arrayLayers = 0;
  GLint framebufferSize = 0;      // smaller of width and height
  GLint vertexStorageBlocks = 0;  // per stage
  GLint fragmentStorageBlocks = 0;
  GLint computeStorageBlocks = 0;
  GLint textureUnits = 0;
  GLint viewports = 0, drawBuffers = 0;  // as StateGuard has to set them
};

struct Api {
#define HALFSILVER_GL_MEMBER(type, name) type name = nullptr;
  HALFSILVER_GL_FUNCTIONS(HALFSILVER_GL_MEMBER)
#undef HALFSILVER_GL_MEMBER

  Limits limits;
  std::string vendor, renderer, version;
  bool restoresState = true;  // see StateGuard
  bool software = false;      // a software rasterizer: the loop limit of its shaders applies (see tracing)

  std::vector<GLenum> programFormats;  // of the linked programs that the driver gives out

  // Programs made so far. Copies of the table share the counts.
  std::shared_ptr<ProgramCounts> programCounts = std::make_shared<ProgramCounts>();

  // Of all made so far, to be held against Limits::storageBlockBytes. Copies of the table share it.
  std::shared_ptr<LargestBuffer> largestBuffer = std::make_shared<LargestBuffer>();

  // How often the host has been made to wait for the GPU (see gl/readback.h). Copies of the table share the count.
  std::shared_ptr<std::uint64_t> hostWaits = std::make_shared<std::uint64_t>(0);

  // The living programs, for gl::reloadPrograms(). Copies of the table share them.
  std::shared_ptr<std::vector<std::weak_ptr<LinkedProgram>>> programs =
      std::make_shared<std::vector<std::weak_ptr<LinkedProgram>>>();

  // Fills the table from the current context. Throws Error (noContext) that names a missing function, a version
  // below 4.5 or a limit that is too small for the project.
  static Api load(const GetProcAddress& getProcAddress);
};

}  // namespace halfsilver::gl
