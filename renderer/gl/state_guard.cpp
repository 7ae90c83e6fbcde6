#include "gl/state_guard.h"

#include <array>
#include <cstddef>
#include <iterator>
#include <vector>

#include "gl/draw_state.h"

namespace halfsilver::gl {

// What the renderer touches or depends on. The members' defaults are GL's initial values.
struct SavedState {
  struct Capability {
    GLenum name;
    bool on;
  };
  struct Range {  // of an indexed buffer binding; size 0: the whole buffer
    GLuint buffer = 0;
    GLint64 start = 0, size = 0;
  };
  struct Image {
    GLint texture = 0, level = 0, layered = 0, layer = 0, access = GL_READ_ONLY, format = GL_R8;
  };
  struct Unit {
    GLuint texture2D = 0, texture2DArray = 0, texture3D = 0, textureBuffer = 0, sampler = 0;
  };
  struct Viewport {
    std::array<float, 4> box{};  // x, y, width, height
    std::array<double, 2> depth{0, 1};
    std::array<GLint, 4> scissor{};
    bool scissorTest = false;
  };
  struct DrawBuffer {
    bool blend = false;
    std::array<GLint, 4> factors{GL_ONE, GL_ZERO, GL_ONE, GL_ZERO};  // source rgb, destination rgb, then alpha
    std::array<GLint, 2> equations{GL_FUNC_ADD, GL_FUNC_ADD};
    std::array<GLboolean, 4> mask{GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE};
  };

  GLuint program = 0, pipeline = 0, vertexArray = 0, drawFramebuffer = 0, readFramebuffer = 0;
  std::vector<Capability> capabilities;
  GLint depthFunction = GL_LESS;
  bool depthMask = true;
  GLint cullFace = GL_BACK, frontFace = GL_CCW, polygonMode = GL_FILL, provokingVertex = GL_LAST_VERTEX_CONVENTION;
  GLint clipOrigin = GL_LOWER_LEFT, clipDepth = GL_NEGATIVE_ONE_TO_ONE;
  float polygonOffsetFactor = 0, polygonOffsetUnits = 0;
  std::vector<Viewport> viewports;
  std::vector<DrawBuffer> drawBuffers;
  GLint activeTexture = GL_TEXTURE0;
  std::array<Unit, 18> units;
  std::array<Image, 8> images;
  std::array<Range, 16> storageBuffers;
  GLuint storageBuffer = 0, uniformBuffer = 0;  // the bindings without an index
  std::array<Range, 2> uniformBuffers;          // of this frame and the one before
  GLuint drawIndirect = 0, dispatchIndirect = 0, packBuffer = 0, unpackBuffer = 0;
  std::array<GLint, 16> pixelStore{0, 0, 0, 0, 0, 0, 0, 4, 0, 0, 0, 0, 0, 0, 0, 4};
};

namespace {

// Capabilities with their initial values.
constexpr SavedState::Capability kCapabilities[] = {
    {GL_DEPTH_TEST, false},
    {GL_DEPTH_CLAMP, false},
    {GL_STENCIL_TEST, false},
    {GL_CULL_FACE, false},
    {GL_POLYGON_OFFSET_FILL, false},
    {GL_FRAMEBUFFER_SRGB, false},
    {GL_RASTERIZER_DISCARD, false},
    {GL_COLOR_LOGIC_OP, false},
    {GL_DITHER, true},
    {GL_MULTISAMPLE, true},
    {GL_SAMPLE_ALPHA_TO_COVERAGE, false},
    {GL_SAMPLE_ALPHA_TO_ONE, false},
    {GL_SAMPLE_COVERAGE, false},
    {GL_SAMPLE_MASK, false},
    {GL_SAMPLE_SHADING, false},
    {GL_PRIMITIVE_RESTART, false},
    {GL_CLIP_DISTANCE0, false},
    {GL_CLIP_DISTANCE1, false},
    {GL_CLIP_DISTANCE2, false},
    {GL_CLIP_DISTANCE3, false},
    {GL_CLIP_DISTANCE4, false},
    {GL_CLIP_DISTANCE5, false},
    {GL_CLIP_DISTANCE6, false},
    {GL_CLIP_DISTANCE7, false},
};

// In the order of SavedState::pixelStore.
constexpr GLenum kPixelStore[] = {
    GL_PACK_SWAP_BYTES,   GL_PACK_LSB_FIRST,     GL_PACK_ROW_LENGTH,    GL_PACK_IMAGE_HEIGHT,
    GL_PACK_SKIP_ROWS,    GL_PACK_SKIP_PIXELS,   GL_PACK_SKIP_IMAGES,   GL_PACK_ALIGNMENT,
    GL_UNPACK_SWAP_BYTES, GL_UNPACK_LSB_FIRST,   GL_UNPACK_ROW_LENGTH,  GL_UNPACK_IMAGE_HEIGHT,
    GL_UNPACK_SKIP_ROWS,  GL_UNPACK_SKIP_PIXELS, GL_UNPACK_SKIP_IMAGES, GL_UNPACK_ALIGNMENT,
};

GLint integer(const Api& api, GLenum name) {
  // Some names (GL_POLYGON_MODE on old drivers) answer with more than one value.
  std::array<GLint, 4> values{};
  api.GetIntegerv(name, values.data());
  return values[0];
}

GLuint object(const Api& api, GLenum name) { return static_cast<GLuint>(integer(api, name)); }

GLint indexed(const Api& api, GLenum name, GLuint index) {
  GLint value = 0;
  api.GetIntegeri_v(name, index, &value);
  return value;
}

SavedState::Range range(const Api& api, GLuint index, GLenum buffer, GLenum start, GLenum size) {
  SavedState::Range range;
  range.buffer = static_cast<GLuint>(indexed(api, buffer, index));
  api.GetInteger64i_v(start, index, &range.start);
  api.GetInteger64i_v(size, index, &range.size);
  return range;
}

void captureBindings(const Api& api, SavedState& state) {
  state.activeTexture = integer(api, GL_ACTIVE_TEXTURE);
  for (std::size_t i = 0; i < state.units.size(); ++i) {
    SavedState::Unit& unit = state.units[i];
    api.ActiveTexture(static_cast<GLenum>(GL_TEXTURE0 + i));
    unit.texture2D = object(api, GL_TEXTURE_BINDING_2D);
    unit.texture2DArray = object(api, GL_TEXTURE_BINDING_2D_ARRAY);
    unit.texture3D = object(api, GL_TEXTURE_BINDING_3D);
    unit.textureBuffer = object(api, GL_TEXTURE_BINDING_BUFFER);
    unit.sampler = object(api, GL_SAMPLER_BINDING);
  }
  api.ActiveTexture(static_cast<GLenum>(state.activeTexture));
  for (std::size_t i = 0; i < state.images.size(); ++i) {
    const GLuint index = static_cast<GLuint>(i);
    state.images[i] = {indexed(api, GL_IMAGE_BINDING_NAME, index),    indexed(api, GL_IMAGE_BINDING_LEVEL, index),
                       indexed(api, GL_IMAGE_BINDING_LAYERED, index), indexed(api, GL_IMAGE_BINDING_LAYER, index),
                       indexed(api, GL_IMAGE_BINDING_ACCESS, index),  indexed(api, GL_IMAGE_BINDING_FORMAT, index)};
  }
  for (std::size_t i = 0; i < state.storageBuffers.size(); ++i)
    state.storageBuffers[i] = range(api, static_cast<GLuint>(i), GL_SHADER_STORAGE_BUFFER_BINDING,
                                    GL_SHADER_STORAGE_BUFFER_START, GL_SHADER_STORAGE_BUFFER_SIZE);
  state.storageBuffer = object(api, GL_SHADER_STORAGE_BUFFER_BINDING);
  for (std::size_t i = 0; i < state.uniformBuffers.size(); ++i)
    state.uniformBuffers[i] =
        range(api, static_cast<GLuint>(i), GL_UNIFORM_BUFFER_BINDING, GL_UNIFORM_BUFFER_START, GL_UNIFORM_BUFFER_SIZE);
  state.uniformBuffer = object(api, GL_UNIFORM_BUFFER_BINDING);
  state.drawIndirect = object(api, GL_DRAW_INDIRECT_BUFFER_BINDING);
  state.dispatchIndirect = object(api, GL_DISPATCH_INDIRECT_BUFFER_BINDING);
  state.packBuffer = object(api, GL_PIXEL_PACK_BUFFER_BINDING);
  state.unpackBuffer = object(api, GL_PIXEL_UNPACK_BUFFER_BINDING);
}

void captureRasterization(const Api& api, SavedState& state) {
  for (const SavedState::Capability& capability : kCapabilities)
    state.capabilities.push_back({capability.name, api.IsEnabled(capability.name) == GL_TRUE});
  state.depthFunction = integer(api, GL_DEPTH_FUNC);
  state.depthMask = integer(api, GL_DEPTH_WRITEMASK) != 0;
  state.cullFace = integer(api, GL_CULL_FACE_MODE);
  state.frontFace = integer(api, GL_FRONT_FACE);
  state.polygonMode = integer(api, GL_POLYGON_MODE);
  state.provokingVertex = integer(api, GL_PROVOKING_VERTEX);
  state.clipOrigin = integer(api, GL_CLIP_ORIGIN);
  state.clipDepth = integer(api, GL_CLIP_DEPTH_MODE);
  api.GetFloatv(GL_POLYGON_OFFSET_FACTOR, &state.polygonOffsetFactor);
  api.GetFloatv(GL_POLYGON_OFFSET_UNITS, &state.polygonOffsetUnits);
  state.viewports.resize(static_cast<std::size_t>(api.limits.viewports));
  for (std::size_t i = 0; i < state.viewports.size(); ++i) {
    SavedState::Viewport& viewport = state.viewports[i];
    const GLuint index = static_cast<GLuint>(i);
    api.GetFloati_v(GL_VIEWPORT, index, viewport.box.data());
    api.GetDoublei_v(GL_DEPTH_RANGE, index, viewport.depth.data());
    api.GetIntegeri_v(GL_SCISSOR_BOX, index, viewport.scissor.data());
    viewport.scissorTest = api.IsEnabledi(GL_SCISSOR_TEST, index) == GL_TRUE;
  }
  state.drawBuffers.resize(static_cast<std::size_t>(api.limits.drawBuffers));
  for (std::size_t i = 0; i < state.drawBuffers.size(); ++i) {
    SavedState::DrawBuffer& buffer = state.drawBuffers[i];
    const GLuint index = static_cast<GLuint>(i);
    buffer.blend = api.IsEnabledi(GL_BLEND, index) == GL_TRUE;
    buffer.factors = {indexed(api, GL_BLEND_SRC_RGB, index), indexed(api, GL_BLEND_DST_RGB, index),
                      indexed(api, GL_BLEND_SRC_ALPHA, index), indexed(api, GL_BLEND_DST_ALPHA, index)};
    buffer.equations = {indexed(api, GL_BLEND_EQUATION_RGB, index), indexed(api, GL_BLEND_EQUATION_ALPHA, index)};
    api.GetBooleani_v(GL_COLOR_WRITEMASK, index, buffer.mask.data());
  }
}

SavedState capture(const Api& api) {
  SavedState state;
  state.program = object(api, GL_CURRENT_PROGRAM);
  state.pipeline = object(api, GL_PROGRAM_PIPELINE_BINDING);
  state.vertexArray = object(api, GL_VERTEX_ARRAY_BINDING);
  state.drawFramebuffer = object(api, GL_DRAW_FRAMEBUFFER_BINDING);
  state.readFramebuffer = object(api, GL_READ_FRAMEBUFFER_BINDING);
  captureRasterization(api, state);
  captureBindings(api, state);
  for (std::size_t i = 0; i < state.pixelStore.size(); ++i) state.pixelStore[i] = integer(api, kPixelStore[i]);
  return state;
}

// The initial values, with the caller's viewports and scissor boxes if they are known.
SavedState initial(const Api& api, const SavedState* caller) {
  SavedState state;
  state.capabilities.assign(std::begin(kCapabilities), std::end(kCapabilities));
  if (caller)
    for (const SavedState::Viewport& viewport : caller->viewports)
      state.viewports.push_back({viewport.box, {0, 1}, viewport.scissor, false});
  state.drawBuffers.resize(static_cast<std::size_t>(api.limits.drawBuffers));
  return state;
}

void setEnabledAt(const Api& api, GLenum capability, std::size_t index, bool on) {
  on ? api.Enablei(capability, static_cast<GLuint>(index)) : api.Disablei(capability, static_cast<GLuint>(index));
}

void bindRange(const Api& api, GLenum target, std::size_t index, const SavedState::Range& range) {
  if (range.buffer && range.size)
    api.BindBufferRange(target, static_cast<GLuint>(index), range.buffer, static_cast<GLintptr>(range.start),
                        static_cast<GLsizeiptr>(range.size));
  else
    api.BindBufferBase(target, static_cast<GLuint>(index), range.buffer);
}

void applyBindings(const Api& api, const SavedState& state) {
  for (std::size_t i = 0; i < state.units.size(); ++i) {
    const SavedState::Unit& unit = state.units[i];
    api.ActiveTexture(static_cast<GLenum>(GL_TEXTURE0 + i));
    api.BindTexture(GL_TEXTURE_2D, unit.texture2D);
    api.BindTexture(GL_TEXTURE_2D_ARRAY, unit.texture2DArray);
    api.BindTexture(GL_TEXTURE_3D, unit.texture3D);
    api.BindTexture(GL_TEXTURE_BUFFER, unit.textureBuffer);
    api.BindSampler(static_cast<GLuint>(i), unit.sampler);
  }
  api.ActiveTexture(static_cast<GLenum>(state.activeTexture));
  for (std::size_t i = 0; i < state.images.size(); ++i) {
    const SavedState::Image& image = state.images[i];
    api.BindImageTexture(static_cast<GLuint>(i), static_cast<GLuint>(image.texture), image.level,
                         static_cast<GLboolean>(image.layered), image.layer, static_cast<GLenum>(image.access),
                         static_cast<GLenum>(image.format));
  }
  // An indexed binding also sets the one without an index, which therefore comes after it.
  for (std::size_t i = 0; i < state.storageBuffers.size(); ++i)
    bindRange(api, GL_SHADER_STORAGE_BUFFER, i, state.storageBuffers[i]);
  api.BindBuffer(GL_SHADER_STORAGE_BUFFER, state.storageBuffer);
  for (std::size_t i = 0; i < state.uniformBuffers.size(); ++i)
    bindRange(api, GL_UNIFORM_BUFFER, i, state.uniformBuffers[i]);
  api.BindBuffer(GL_UNIFORM_BUFFER, state.uniformBuffer);
  api.BindBuffer(GL_DRAW_INDIRECT_BUFFER, state.drawIndirect);
  api.BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, state.dispatchIndirect);
  api.BindBuffer(GL_PIXEL_PACK_BUFFER, state.packBuffer);
  api.BindBuffer(GL_PIXEL_UNPACK_BUFFER, state.unpackBuffer);
}

void applyRasterization(const Api& api, const SavedState& state) {
  for (const SavedState::Capability& capability : state.capabilities) setEnabled(api, capability.name, capability.on);
  api.DepthFunc(static_cast<GLenum>(state.depthFunction));
  api.DepthMask(state.depthMask);
  api.CullFace(static_cast<GLenum>(state.cullFace));
  api.FrontFace(static_cast<GLenum>(state.frontFace));
  api.PolygonMode(GL_FRONT_AND_BACK, static_cast<GLenum>(state.polygonMode));
  api.ProvokingVertex(static_cast<GLenum>(state.provokingVertex));
  api.ClipControl(static_cast<GLenum>(state.clipOrigin), static_cast<GLenum>(state.clipDepth));
  api.PolygonOffset(state.polygonOffsetFactor, state.polygonOffsetUnits);
  for (std::size_t i = 0; i < state.viewports.size(); ++i) {
    const SavedState::Viewport& viewport = state.viewports[i];
    const GLuint index = static_cast<GLuint>(i);
    api.ViewportIndexedf(index, viewport.box[0], viewport.box[1], viewport.box[2], viewport.box[3]);
    api.DepthRangeIndexed(index, viewport.depth[0], viewport.depth[1]);
    api.ScissorIndexed(index, viewport.scissor[0], viewport.scissor[1], viewport.scissor[2], viewport.scissor[3]);
    setEnabledAt(api, GL_SCISSOR_TEST, i, viewport.scissorTest);
  }
  for (std::size_t i = 0; i < state.drawBuffers.size(); ++i) {
    const SavedState::DrawBuffer& buffer = state.drawBuffers[i];
    const GLuint index = static_cast<GLuint>(i);
    const auto factor = [&buffer](std::size_t n) { return static_cast<GLenum>(buffer.factors[n]); };
    setEnabledAt(api, GL_BLEND, i, buffer.blend);
    api.BlendFuncSeparatei(index, factor(0), factor(1), factor(2), factor(3));
    api.BlendEquationSeparatei(index, static_cast<GLenum>(buffer.equations[0]),
                               static_cast<GLenum>(buffer.equations[1]));
    api.ColorMaski(index, buffer.mask[0], buffer.mask[1], buffer.mask[2], buffer.mask[3]);
  }
}

// Of all viewports, without their boxes.
void resetViewports(const Api& api) {
  api.DepthRange(0, 1);
  api.Disable(GL_SCISSOR_TEST);
}

void apply(const Api& api, const SavedState& state) {
  api.UseProgram(state.program);
  api.BindProgramPipeline(state.pipeline);
  api.BindVertexArray(state.vertexArray);
  api.BindFramebuffer(GL_DRAW_FRAMEBUFFER, state.drawFramebuffer);
  api.BindFramebuffer(GL_READ_FRAMEBUFFER, state.readFramebuffer);
  applyRasterization(api, state);
  applyBindings(api, state);
  for (std::size_t i = 0; i < state.pixelStore.size(); ++i) api.PixelStorei(kPixelStore[i], state.pixelStore[i]);
}

}  // namespace

StateGuard::StateGuard(const Api& api) : api_(&api) {
  if (api.restoresState) saved_ = std::make_unique<const SavedState>(capture(api));
  apply(api, initial(api, saved_.get()));
  if (!saved_) resetViewports(api);
}

StateGuard::~StateGuard() {
  if (saved_) apply(*api_, *saved_);
}

}  // namespace halfsilver::gl
