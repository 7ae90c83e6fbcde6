#include "gl_state.h"

#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>

namespace {

struct Name {
  const char* text;
  GLenum name;
};
#define NAME(name) \
  Name { #name, name }

constexpr Name kSingle[] = {
    NAME(GL_CURRENT_PROGRAM),
    NAME(GL_PROGRAM_PIPELINE_BINDING),
    NAME(GL_VERTEX_ARRAY_BINDING),
    NAME(GL_ELEMENT_ARRAY_BUFFER_BINDING),
    NAME(GL_ARRAY_BUFFER_BINDING),
    NAME(GL_COPY_READ_BUFFER_BINDING),
    NAME(GL_COPY_WRITE_BUFFER_BINDING),
    NAME(GL_UNIFORM_BUFFER_BINDING),
    NAME(GL_SHADER_STORAGE_BUFFER_BINDING),
    NAME(GL_ATOMIC_COUNTER_BUFFER_BINDING),
    NAME(GL_DRAW_INDIRECT_BUFFER_BINDING),
    NAME(GL_DISPATCH_INDIRECT_BUFFER_BINDING),
    NAME(GL_PIXEL_PACK_BUFFER_BINDING),
    NAME(GL_PIXEL_UNPACK_BUFFER_BINDING),
    NAME(GL_DRAW_FRAMEBUFFER_BINDING),
    NAME(GL_READ_FRAMEBUFFER_BINDING),
    NAME(GL_RENDERBUFFER_BINDING),
    NAME(GL_ACTIVE_TEXTURE),
    NAME(GL_DEPTH_TEST),
    NAME(GL_DEPTH_FUNC),
    NAME(GL_DEPTH_WRITEMASK),
    NAME(GL_DEPTH_CLAMP),
    NAME(GL_DEPTH_CLEAR_VALUE),
    NAME(GL_COLOR_CLEAR_VALUE),
    NAME(GL_STENCIL_TEST),
    NAME(GL_STENCIL_WRITEMASK),
    NAME(GL_CLIP_ORIGIN),
    NAME(GL_CLIP_DEPTH_MODE),
    NAME(GL_CLIP_DISTANCE0),
    NAME(GL_CULL_FACE),
    NAME(GL_CULL_FACE_MODE),
    NAME(GL_FRONT_FACE),
    NAME(GL_POLYGON_MODE),
    NAME(GL_POLYGON_OFFSET_FILL),
    NAME(GL_POLYGON_OFFSET_FACTOR),
    NAME(GL_POLYGON_OFFSET_UNITS),
    NAME(GL_PROVOKING_VERTEX),
    NAME(GL_PRIMITIVE_RESTART),
    NAME(GL_RASTERIZER_DISCARD),
    NAME(GL_MULTISAMPLE),
    NAME(GL_SAMPLE_ALPHA_TO_COVERAGE),
    NAME(GL_SAMPLE_MASK),
    NAME(GL_FRAMEBUFFER_SRGB),
    NAME(GL_COLOR_LOGIC_OP),
    NAME(GL_DITHER),
    NAME(GL_LINE_WIDTH),
    NAME(GL_PACK_ALIGNMENT),
    NAME(GL_PACK_ROW_LENGTH),
    NAME(GL_PACK_SKIP_ROWS),
    NAME(GL_PACK_SKIP_PIXELS),
    NAME(GL_UNPACK_ALIGNMENT),
    NAME(GL_UNPACK_ROW_LENGTH),
    NAME(GL_UNPACK_SKIP_ROWS),
    NAME(GL_UNPACK_SKIP_PIXELS),
};

constexpr Name kViewports[] = {NAME(GL_VIEWPORT), NAME(GL_DEPTH_RANGE), NAME(GL_SCISSOR_BOX), NAME(GL_SCISSOR_TEST)};
constexpr Name kDrawBuffers[] = {NAME(GL_BLEND),           NAME(GL_BLEND_SRC_RGB),       NAME(GL_BLEND_DST_RGB),
                                 NAME(GL_BLEND_SRC_ALPHA), NAME(GL_BLEND_DST_ALPHA),     NAME(GL_BLEND_EQUATION_RGB),
                                 NAME(GL_COLOR_WRITEMASK), NAME(GL_BLEND_EQUATION_ALPHA)};
constexpr Name kUniformBuffers[] = {NAME(GL_UNIFORM_BUFFER_BINDING), NAME(GL_UNIFORM_BUFFER_START),
                                    NAME(GL_UNIFORM_BUFFER_SIZE)};
constexpr Name kStorageBuffers[] = {NAME(GL_SHADER_STORAGE_BUFFER_BINDING), NAME(GL_SHADER_STORAGE_BUFFER_START),
                                    NAME(GL_SHADER_STORAGE_BUFFER_SIZE)};
constexpr Name kImages[] = {NAME(GL_IMAGE_BINDING_NAME),  NAME(GL_IMAGE_BINDING_LEVEL),  NAME(GL_IMAGE_BINDING_LAYERED),
                            NAME(GL_IMAGE_BINDING_LAYER), NAME(GL_IMAGE_BINDING_ACCESS), NAME(GL_IMAGE_BINDING_FORMAT)};
constexpr Name kTextures[] = {NAME(GL_TEXTURE_BINDING_2D),       NAME(GL_TEXTURE_BINDING_2D_ARRAY),
                              NAME(GL_TEXTURE_BINDING_3D),       NAME(GL_TEXTURE_BINDING_BUFFER),
                              NAME(GL_TEXTURE_BINDING_CUBE_MAP), NAME(GL_SAMPLER_BINDING)};

std::vector<double> single(GLenum name) {
  std::vector<double> value(4);
  glGetDoublev(name, value.data());
  return value;
}

std::vector<double> indexed(GLenum name, GLuint index) {
  std::vector<double> value(4);
  if (name == GL_BLEND || name == GL_SCISSOR_TEST)
    value[0] = glIsEnabledi(name, index);
  else
    glGetDoublei_v(name, index, value.data());
  return value;
}

template <std::size_t kNames>
void addIndexed(std::vector<GlValue>& state, const Name (&names)[kNames], GLenum countName) {
  const auto count = static_cast<GLuint>(single(countName)[0]);
  for (GLuint index = 0; index < count; ++index)
    for (const Name& name : names)
      state.push_back({name.text + ("[" + std::to_string(index) + "]"), indexed(name.name, index)});
}

}  // namespace

std::vector<GlValue> glState() {
  std::vector<GlValue> state;
  for (const Name& name : kSingle) state.push_back({name.text, single(name.name)});
  addIndexed(state, kViewports, GL_MAX_VIEWPORTS);
  addIndexed(state, kDrawBuffers, GL_MAX_DRAW_BUFFERS);
  addIndexed(state, kUniformBuffers, GL_MAX_UNIFORM_BUFFER_BINDINGS);
  addIndexed(state, kStorageBuffers, GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS);
  addIndexed(state, kImages, GL_MAX_IMAGE_UNITS);
  const auto active = static_cast<GLenum>(single(GL_ACTIVE_TEXTURE)[0]);
  for (GLuint unit = 0; unit < static_cast<GLuint>(single(GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS)[0]); ++unit) {
    glActiveTexture(GL_TEXTURE0 + unit);
    for (const Name& name : kTextures)
      state.push_back({name.text + ("[" + std::to_string(unit) + "]"), single(name.name)});
  }
  glActiveTexture(active);
  return state;
}

std::vector<std::string> differences(const std::vector<GlValue>& before, const std::vector<GlValue>& after) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < before.size(); ++i)
    if (before[i] != after[i]) names.push_back(before[i].name);
  return names;
}
