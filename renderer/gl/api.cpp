#include <halfsilver/gl/api.h>

#include <algorithm>

#include <halfsilver/error.h>
#include "gl/limits.h"

namespace halfsilver::gl {
namespace {

std::string text(const Api& api, GLenum name) {
  const GLubyte* value = api.GetString(name);
  return value ? reinterpret_cast<const char*>(value) : "unknown";
}

// Programs are checked for more when they are linked.
void requireNeeds(const Limits& limits) {
  for (const Need& need : needsOf(limits))
    if (need.offered < need.least)
      throw Error(ErrorKind::noContext, "the GL device offers " + std::to_string(need.offered) + " " + need.what +
                                            ", " + std::to_string(need.least) + " are needed");
}

Limits readLimits(const Api& api) {
  Limits limits;
  api.GetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &limits.storageBlockBytes);
  api.GetInteger64v(GL_MAX_TEXTURE_BUFFER_SIZE, &limits.bufferTexels);
  api.GetIntegerv(GL_MAX_TEXTURE_SIZE, &limits.textureSize);
  api.GetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &limits.arrayLayers);
  GLint width = 0, height = 0;
  api.GetIntegerv(GL_MAX_FRAMEBUFFER_WIDTH, &width);
  api.GetIntegerv(GL_MAX_FRAMEBUFFER_HEIGHT, &height);
  limits.framebufferSize = std::min({width, height, limits.textureSize});
  api.GetIntegerv(GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS, &limits.vertexStorageBlocks);
  api.GetIntegerv(GL_MAX_FRAGMENT_SHADER_STORAGE_BLOCKS, &limits.fragmentStorageBlocks);
  api.GetIntegerv(GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS, &limits.computeStorageBlocks);
  api.GetIntegerv(GL_MAX_TEXTURE_IMAGE_UNITS, &limits.textureUnits);
  api.GetIntegerv(GL_MAX_VIEWPORTS, &limits.viewports);
  api.GetIntegerv(GL_MAX_DRAW_BUFFERS, &limits.drawBuffers);
  return limits;
}

std::vector<GLenum> readProgramFormats(const Api& api) {
  GLint count = 0;
  api.GetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &count);
  std::vector<GLint> formats(static_cast<std::size_t>(std::max(count, 0)));
  if (!formats.empty()) api.GetIntegerv(GL_PROGRAM_BINARY_FORMATS, formats.data());
  return {formats.begin(), formats.end()};
}

}  // namespace

Api Api::load(const GetProcAddress& getProcAddress) {
  Api api;
#define HALFSILVER_GL_LOAD(type, name)                                          \
  api.name = reinterpret_cast<type>(getProcAddress("gl" #name));                \
  if (!api.name)                                                                \
    throw Error(ErrorKind::noContext, "the GL context has no function gl" #name \
                                      " (OpenGL 4.5 is "                        \
                                      "needed)");
  HALFSILVER_GL_FUNCTIONS(HALFSILVER_GL_LOAD)
#undef HALFSILVER_GL_LOAD

  api.vendor = text(api, GL_VENDOR);
  api.renderer = text(api, GL_RENDERER);
  api.version = text(api, GL_VERSION);
  GLint major = 0, minor = 0;
  api.GetIntegerv(GL_MAJOR_VERSION, &major);
  api.GetIntegerv(GL_MINOR_VERSION, &minor);
  if (major * 10 + minor < 45)
    throw Error(ErrorKind::noContext, "the GL context is version " + std::to_string(major) + "." +
                                          std::to_string(minor) + " (" + api.renderer + "), 4.5 is needed");
  for (const char* name :
       {"llvmpipe", "softpipe", "SWR", "SwiftShader", "Software Rasterizer", "Microsoft Basic Render", "SVGA3D"})
    api.software = api.software || api.renderer.find(name) != std::string::npos;
  api.limits = readLimits(api);
  requireNeeds(api.limits);
  api.programFormats = readProgramFormats(api);
  return api;
}

}  // namespace halfsilver::gl
