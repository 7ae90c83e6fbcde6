#include "gpu/binding_audit.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace halfsilver::testing {
namespace {

// State of a draw by the name of its query; the last one counts only if that capability is on.
struct DrawStateItem {
  GLenum name;
  const char* words;
  GLenum onlyWith = GL_NONE;
};
constexpr DrawStateItem kDrawState[] = {
    {GL_DRAW_FRAMEBUFFER_BINDING, "framebuffer"},
    {GL_VERTEX_ARRAY_BINDING, "vertex array"},
    {GL_VIEWPORT, "viewport"},
    {GL_SCISSOR_TEST, "scissor test"},
    {GL_STENCIL_TEST, "stencil test"},
    {GL_BLEND, "blending"},
    {GL_COLOR_WRITEMASK, "color mask"},
    {GL_RASTERIZER_DISCARD, "rasterizer discard"},
    {GL_POLYGON_OFFSET_FILL, "polygon offset"},
    {GL_CLIP_DEPTH_MODE, "clip control"},
    {GL_DEPTH_TEST, "depth test"},
    {GL_DEPTH_FUNC, "depth function", GL_DEPTH_TEST},
    {GL_DEPTH_WRITEMASK, "depth mask", GL_DEPTH_TEST},
    {GL_DEPTH_RANGE, "depth range", GL_DEPTH_TEST},
    {GL_CULL_FACE, "face culling"},
    {GL_CULL_FACE_MODE, "culled face", GL_CULL_FACE},
    {GL_FRONT_FACE, "front face", GL_CULL_FACE},
};

bool isSampler(GLenum type) {
  return (type >= GL_SAMPLER_1D && type <= GL_SAMPLER_2D_RECT_SHADOW) ||
         (type >= GL_SAMPLER_1D_ARRAY && type <= GL_SAMPLER_CUBE_SHADOW) ||
         (type >= GL_INT_SAMPLER_1D && type <= GL_UNSIGNED_INT_SAMPLER_BUFFER) ||
         (type >= GL_SAMPLER_CUBE_MAP_ARRAY && type <= GL_UNSIGNED_INT_SAMPLER_CUBE_MAP_ARRAY) ||
         (type >= GL_SAMPLER_2D_MULTISAMPLE && type <= GL_UNSIGNED_INT_SAMPLER_2D_MULTISAMPLE_ARRAY);
}
bool isImage(GLenum type) { return type >= GL_IMAGE_1D && type <= GL_UNSIGNED_INT_IMAGE_2D_MULTISAMPLE_ARRAY; }

struct Pass {
  explicit Pass(std::string text) : name(std::move(text)) {}

  std::string name;
  bool program = false;
  std::set<std::pair<GLenum, GLuint>> buffers;  // target; number, 0 for targets without
  std::set<GLuint> textures, images;
  std::set<GLenum> drawState;
  std::map<GLuint, std::pair<std::string, std::string>> blocks;  // storage number -> block, program
};

}  // namespace

struct BindingAudit::Recorder {
  explicit Recorder(const gl::GetProcAddress& getProcAddress) : real(getProcAddress), gl(gl::Api::load(real)) {
    load(getProgramResourceiv, "glGetProgramResourceiv");
    load(getProgramResourceName, "glGetProgramResourceName");
    load(getUniformiv, "glGetUniformiv");
    load(getObjectLabel, "glGetObjectLabel");
  }

  template <class Function>
  void load(Function& function, const char* name) const {
    function = reinterpret_cast<Function>(real(name));
    if (!function) throw std::runtime_error(std::string("no function ") + name);
  }

  gl::GetProcAddress real;
  gl::Api gl;
  PFNGLGETPROGRAMRESOURCEIVPROC getProgramResourceiv;
  PFNGLGETPROGRAMRESOURCENAMEPROC getProgramResourceName;
  PFNGLGETUNIFORMIVPROC getUniformiv;
  PFNGLGETOBJECTLABELPROC getObjectLabel;

  std::vector<Pass> passes{Pass("outside of all passes")};  // a stack
  GLuint program = 0;
  std::vector<std::string> complaints;
  std::map<std::string, std::size_t> checks;

  Pass& pass() { return passes.back(); }

  void complain(const std::string& what) {
    const std::string sentence = "pass '" + pass().name + "': " + what;
    if (std::find(complaints.begin(), complaints.end(), sentence) == complaints.end()) complaints.push_back(sentence);
  }

  std::string label() const {
    std::array<char, 256> text{};
    getObjectLabel(GL_PROGRAM, program, static_cast<GLsizei>(text.size()), nullptr, text.data());
    return text[0] ? text.data() : "number " + std::to_string(program);
  }

  std::string resourceName(GLenum interface, GLint index) const {
    std::array<char, 256> text{};
    getProgramResourceName(program, interface, static_cast<GLuint>(index), static_cast<GLsizei>(text.size()), nullptr,
                           text.data());
    return text.data();
  }

  GLint resourceCount(GLenum interface) const {
    GLint count = 0;
    gl.GetProgramInterfaceiv(program, interface, GL_ACTIVE_RESOURCES, &count);
    return count;
  }

  template <std::size_t count>
  std::array<GLint, count> properties(GLenum interface, GLint index, const std::array<GLenum, count>& names) const {
    std::array<GLint, count> values{};
    getProgramResourceiv(program, interface, static_cast<GLuint>(index), static_cast<GLsizei>(count), names.data(),
                         static_cast<GLsizei>(count), nullptr, values.data());
    return values;
  }

  void checkBlocks(GLenum interface, GLenum target, const char* kind) {
    for (GLint i = 0; i < resourceCount(interface); ++i) {
      const auto number = static_cast<GLuint>(properties<1>(interface, i, {GL_BUFFER_BINDING})[0]);
      const std::string name = resourceName(interface, i);
      if (!pass().buffers.contains({target, number}))
        complain(kind + (" " + name) + " (number " + std::to_string(number) + ") of program " + label() +
                 " was not bound by the pass");
      if (target != GL_SHADER_STORAGE_BUFFER) continue;
      const auto& [first, user] = *pass().blocks.try_emplace(number, name, label()).first;
      if (user.first != name)
        complain("storage number " + std::to_string(number) + " is " + user.first + " of program " + user.second +
                 " and " + name + " of program " + label());
    }
  }

  // Samplers and images: the default block's uniforms hold the numbers of their units.
  void checkUnits() {
    for (GLint i = 0; i < resourceCount(GL_UNIFORM); ++i) {
      const auto [type, location, size] = properties<3>(GL_UNIFORM, i, {GL_TYPE, GL_LOCATION, GL_ARRAY_SIZE});
      const bool sampler = isSampler(static_cast<GLenum>(type));
      if (!sampler && !isImage(static_cast<GLenum>(type))) continue;
      const std::string name = resourceName(GL_UNIFORM, i), stem = name.substr(0, name.find("[0]"));
      for (GLint element = 0; element < size; ++element) {
        GLint unit = 0;
        getUniformiv(program, location + element, &unit);
        if (!(sampler ? pass().textures : pass().images).contains(static_cast<GLuint>(unit)))
          complain((sampler ? "sampler " : "image ") +
                   (stem == name ? name : stem + '[' + std::to_string(element) + ']') + " (unit " +
                   std::to_string(unit) + ") of program " + label() + " was not bound by the pass");
      }
    }
  }

  void check() {
    ++checks[pass().name];
    if (!pass().program) complain("program " + label() + " was not chosen by the pass");
    checkBlocks(GL_SHADER_STORAGE_BLOCK, GL_SHADER_STORAGE_BUFFER, "block");
    checkBlocks(GL_UNIFORM_BLOCK, GL_UNIFORM_BUFFER, "uniform block");
    checkUnits();
  }

  void checkIndirect(GLenum target, const char* what) {
    if (!pass().buffers.contains({target, 0}))
      complain(std::string("the arguments of an indirect ") + what + " with program " + label() +
               " were not bound by the pass");
  }

  void checkDraw() {
    check();
    for (const DrawStateItem& item : kDrawState)
      if (!pass().drawState.contains(item.name) && (item.onlyWith == GL_NONE || gl.IsEnabled(item.onlyWith)))
        complain(std::string("the ") + item.words + " was not set by the pass that draws with program " + label());
  }

  void set(GLenum state) { pass().drawState.insert(state); }
  void setBuffer(GLenum target, GLuint number, GLuint name) {
    if (name != 0)
      pass().buffers.insert({target, number});
    else
      pass().buffers.erase({target, number});
  }
  static void setUnit(std::set<GLuint>& units, GLuint unit, GLuint name) {
    if (name != 0)
      units.insert(unit);
    else
      units.erase(unit);
  }

  // Named for the functions that they watch, with the functions' arguments.
  void pushDebugGroup(GLenum, GLuint, GLsizei length, const GLchar* text) {
    passes.emplace_back(length < 0 ? std::string(text) : std::string(text, static_cast<std::size_t>(length)));
  }
  void popDebugGroup() {
    if (passes.size() > 1) passes.pop_back();
  }
  void useProgram(GLuint name) {
    program = name;
    pass().program = true;
  }
  void bindBuffer(GLenum target, GLuint name) { setBuffer(target, 0, name); }
  void bindBufferBase(GLenum target, GLuint number, GLuint name) { setBuffer(target, number, name); }
  void bindBufferRange(GLenum target, GLuint number, GLuint name, GLintptr, GLsizeiptr) {
    setBuffer(target, number, name);
  }
  void bindTextureUnit(GLuint unit, GLuint name) { setUnit(pass().textures, unit, name); }
  void bindImageTexture(GLuint unit, GLuint name, GLint, GLboolean, GLint, GLenum, GLenum) {
    setUnit(pass().images, unit, name);
  }
  void dispatchCompute(GLuint, GLuint, GLuint) { check(); }
  void dispatchComputeIndirect(GLintptr) {
    checkIndirect(GL_DISPATCH_INDIRECT_BUFFER, "dispatch");
    check();
  }
  void drawArrays(GLenum, GLint, GLsizei) { checkDraw(); }
  void multiDrawArrays(GLenum, const GLint*, const GLsizei*, GLsizei) { checkDraw(); }
  void multiDrawElements(GLenum, const GLsizei*, GLenum, const void* const*, GLsizei) {
    if (!pass().buffers.contains({GL_ELEMENT_ARRAY_BUFFER, 0}))
      complain("the indices drawn with program " + label() + " were not bound by the pass");
    checkDraw();
  }
  void drawArraysInstanced(GLenum, GLint, GLsizei, GLsizei) { checkDraw(); }
  void drawArraysIndirect(GLenum, const void*) {
    checkIndirect(GL_DRAW_INDIRECT_BUFFER, "draw");
    checkDraw();
  }
  void enable(GLenum capability) { set(capability); }
  void viewport(GLint, GLint, GLsizei, GLsizei) { set(GL_VIEWPORT); }
  void bindFramebuffer(GLenum target, GLuint) {
    if (target != GL_READ_FRAMEBUFFER) set(GL_DRAW_FRAMEBUFFER_BINDING);
  }
  void bindVertexArray(GLuint) { set(GL_VERTEX_ARRAY_BINDING); }
  void colorMask(GLboolean, GLboolean, GLboolean, GLboolean) { set(GL_COLOR_WRITEMASK); }
  void depthMask(GLboolean) { set(GL_DEPTH_WRITEMASK); }
  void depthFunc(GLenum) { set(GL_DEPTH_FUNC); }
  void depthRange(GLdouble, GLdouble) { set(GL_DEPTH_RANGE); }
  void clipControl(GLenum, GLenum) { set(GL_CLIP_DEPTH_MODE); }
  void cullFace(GLenum) { set(GL_CULL_FACE_MODE); }
  void frontFace(GLenum) { set(GL_FRONT_FACE); }

  static thread_local Recorder* active;  // GL's functions have no room for an object

  static const std::map<std::string, gl::Proc> watched;
};

thread_local BindingAudit::Recorder* BindingAudit::Recorder::active = nullptr;

namespace {

using Recorder = BindingAudit::Recorder;

// A GL function that notes its arguments and passes them on.
template <auto Function, auto Note, class Signature>
struct Watch;
template <auto Function, auto Note, class... Arguments>
struct Watch<Function, Note, void (*)(Arguments...)> {
  static void APIENTRY call(Arguments... arguments) {
    (Recorder::active->*Note)(arguments...);
    (Recorder::active->gl.*Function)(arguments...);
  }
};

template <auto Function, auto Note>
gl::Proc watch() {
  using Signature = std::remove_cvref_t<decltype(std::declval<gl::Api&>().*Function)>;
  return reinterpret_cast<gl::Proc>(&Watch<Function, Note, Signature>::call);
}

}  // namespace

const std::map<std::string, gl::Proc> BindingAudit::Recorder::watched = {
    {"glPushDebugGroup", watch<&gl::Api::PushDebugGroup, &Recorder::pushDebugGroup>()},
    {"glPopDebugGroup", watch<&gl::Api::PopDebugGroup, &Recorder::popDebugGroup>()},
    {"glUseProgram", watch<&gl::Api::UseProgram, &Recorder::useProgram>()},
    {"glBindBuffer", watch<&gl::Api::BindBuffer, &Recorder::bindBuffer>()},
    {"glBindBufferBase", watch<&gl::Api::BindBufferBase, &Recorder::bindBufferBase>()},
    {"glBindBufferRange", watch<&gl::Api::BindBufferRange, &Recorder::bindBufferRange>()},
    {"glBindTextureUnit", watch<&gl::Api::BindTextureUnit, &Recorder::bindTextureUnit>()},
    {"glBindImageTexture", watch<&gl::Api::BindImageTexture, &Recorder::bindImageTexture>()},
    {"glDispatchCompute", watch<&gl::Api::DispatchCompute, &Recorder::dispatchCompute>()},
    {"glDispatchComputeIndirect", watch<&gl::Api::DispatchComputeIndirect, &Recorder::dispatchComputeIndirect>()},
    {"glDrawArrays", watch<&gl::Api::DrawArrays, &Recorder::drawArrays>()},
    {"glMultiDrawElements", watch<&gl::Api::MultiDrawElements, &Recorder::multiDrawElements>()},
    {"glMultiDrawArrays", watch<&gl::Api::MultiDrawArrays, &Recorder::multiDrawArrays>()},
    {"glDrawArraysInstanced", watch<&gl::Api::DrawArraysInstanced, &Recorder::drawArraysInstanced>()},
    {"glDrawArraysIndirect", watch<&gl::Api::DrawArraysIndirect, &Recorder::drawArraysIndirect>()},
    {"glEnable", watch<&gl::Api::Enable, &Recorder::enable>()},
    {"glDisable", watch<&gl::Api::Disable, &Recorder::enable>()},
    {"glViewport", watch<&gl::Api::Viewport, &Recorder::viewport>()},
    {"glBindFramebuffer", watch<&gl::Api::BindFramebuffer, &Recorder::bindFramebuffer>()},
    {"glBindVertexArray", watch<&gl::Api::BindVertexArray, &Recorder::bindVertexArray>()},
    {"glColorMask", watch<&gl::Api::ColorMask, &Recorder::colorMask>()},
    {"glDepthMask", watch<&gl::Api::DepthMask, &Recorder::depthMask>()},
    {"glDepthFunc", watch<&gl::Api::DepthFunc, &Recorder::depthFunc>()},
    {"glDepthRange", watch<&gl::Api::DepthRange, &Recorder::depthRange>()},
    {"glClipControl", watch<&gl::Api::ClipControl, &Recorder::clipControl>()},
    {"glCullFace", watch<&gl::Api::CullFace, &Recorder::cullFace>()},
    {"glFrontFace", watch<&gl::Api::FrontFace, &Recorder::frontFace>()},
};

BindingAudit::BindingAudit(const gl::GetProcAddress& getProcAddress)
    : recorder_(std::make_unique<Recorder>(getProcAddress)) {
  Recorder::active = recorder_.get();
}

BindingAudit::~BindingAudit() { Recorder::active = nullptr; }

gl::GetProcAddress BindingAudit::getProcAddress() const {
  return [real = recorder_->real](const char* name) {
    const auto known = Recorder::watched.find(name);
    return known == Recorder::watched.end() ? real(name) : known->second;
  };
}

const std::vector<std::string>& BindingAudit::complaints() const { return recorder_->complaints; }

std::size_t BindingAudit::checks(const std::string& pass) const {
  const auto known = recorder_->checks.find(pass);
  return known == recorder_->checks.end() ? 0 : known->second;
}

}  // namespace halfsilver::testing
