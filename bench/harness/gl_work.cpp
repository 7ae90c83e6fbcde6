#include "bench/harness/gl_work.h"

#include <cstring>
#include <ctime>
#include <utility>
#include <vector>

namespace halfsilver::bench {

namespace {

double cpuMilliseconds() { return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace

struct GlWatch::Watcher {
  gl::GetProcAddress original;
  GlWork work;
  struct Group {
    std::string name;
    double begin;
  };
  std::vector<Group> groups;

  PFNGLFINISHPROC Finish = nullptr;
  PFNGLCLIENTWAITSYNCPROC ClientWaitSync = nullptr;
  PFNGLGETNAMEDBUFFERSUBDATAPROC GetNamedBufferSubData = nullptr;
  PFNGLGETQUERYOBJECTUI64VPROC GetQueryObjectui64v = nullptr;
  PFNGLDISPATCHCOMPUTEPROC DispatchCompute = nullptr;
  PFNGLDISPATCHCOMPUTEINDIRECTPROC DispatchComputeIndirect = nullptr;
  PFNGLDRAWARRAYSPROC DrawArrays = nullptr;
  PFNGLDRAWARRAYSINSTANCEDPROC DrawArraysInstanced = nullptr;
  PFNGLDRAWARRAYSINDIRECTPROC DrawArraysIndirect = nullptr;
  PFNGLMULTIDRAWARRAYSPROC MultiDrawArrays = nullptr;
  PFNGLMULTIDRAWELEMENTSPROC MultiDrawElements = nullptr;
  PFNGLPUSHDEBUGGROUPPROC PushDebugGroup = nullptr;
  PFNGLPOPDEBUGGROUPPROC PopDebugGroup = nullptr;
};

namespace {

GlWatch::Watcher* watcher = nullptr;  // GL's functions know no object

void APIENTRY watchFinish() {
  ++watcher->work.waits;
  watcher->Finish();
}
GLenum APIENTRY watchClientWaitSync(GLsync sync, GLbitfield flags, GLuint64 timeout) {
  watcher->work.waits += timeout > 0;
  return watcher->ClientWaitSync(sync, flags, timeout);
}
void APIENTRY watchGetNamedBufferSubData(GLuint buffer, GLintptr offset, GLsizeiptr size, void* data) {
  ++watcher->work.waits;
  watcher->GetNamedBufferSubData(buffer, offset, size, data);
}
void APIENTRY watchGetQueryObject(GLuint query, GLenum name, GLuint64* value) {
  watcher->work.waits += name == GL_QUERY_RESULT;
  watcher->GetQueryObjectui64v(query, name, value);
}
void APIENTRY watchDispatchCompute(GLuint x, GLuint y, GLuint z) {
  ++watcher->work.dispatches;
  watcher->DispatchCompute(x, y, z);
}
void APIENTRY watchDispatchComputeIndirect(GLintptr offset) {
  ++watcher->work.dispatches;
  watcher->DispatchComputeIndirect(offset);
}
void APIENTRY watchDrawArrays(GLenum mode, GLint first, GLsizei count) {
  ++watcher->work.draws;
  watcher->DrawArrays(mode, first, count);
}
void APIENTRY watchDrawArraysInstanced(GLenum mode, GLint first, GLsizei count, GLsizei instances) {
  ++watcher->work.draws;
  watcher->DrawArraysInstanced(mode, first, count, instances);
}
void APIENTRY watchDrawArraysIndirect(GLenum mode, const void* indirect) {
  ++watcher->work.draws;
  watcher->DrawArraysIndirect(mode, indirect);
}
void APIENTRY watchMultiDrawArrays(GLenum mode, const GLint* firsts, const GLsizei* counts, GLsizei draws) {
  ++watcher->work.draws;
  watcher->MultiDrawArrays(mode, firsts, counts, draws);
}
void APIENTRY watchMultiDrawElements(GLenum mode, const GLsizei* counts, GLenum type, const void* const* indices,
                                     GLsizei draws) {
  ++watcher->work.draws;
  watcher->MultiDrawElements(mode, counts, type, indices, draws);
}
void APIENTRY watchPushDebugGroup(GLenum source, GLuint id, GLsizei length, const GLchar* message) {
  watcher->PushDebugGroup(source, id, length, message);
  const std::string name = length < 0 ? std::string(message) : std::string(message, static_cast<std::size_t>(length));
  watcher->groups.push_back({name, cpuMilliseconds()});
}
void APIENTRY watchPopDebugGroup() {
  if (!watcher->groups.empty()) {
    const auto& group = watcher->groups.back();
    watcher->work.cpu[group.name] += cpuMilliseconds() - group.begin;
    watcher->groups.pop_back();
  }
  watcher->PopDebugGroup();
}

}  // namespace

GlWatch::GlWatch(const gl::GetProcAddress& getProcAddress) : watcher_(std::make_unique<Watcher>()) {
  watcher_->original = getProcAddress;
  watcher = watcher_.get();
}

GlWatch::~GlWatch() { watcher = nullptr; }

gl::GetProcAddress GlWatch::getProcAddress() const {
  return [](const char* name) -> gl::Proc {
    const gl::Proc original = watcher->original(name);
    gl::Proc result = original;
    const auto watch = [&](const char* function, auto& kept, auto* watching) {
      if (!original || std::strcmp(name, function) != 0) return;
      kept = reinterpret_cast<std::remove_reference_t<decltype(kept)>>(original);
      result = reinterpret_cast<gl::Proc>(watching);
    };
    watch("glFinish", watcher->Finish, watchFinish);
    watch("glClientWaitSync", watcher->ClientWaitSync, watchClientWaitSync);
    watch("glGetNamedBufferSubData", watcher->GetNamedBufferSubData, watchGetNamedBufferSubData);
    watch("glGetQueryObjectui64v", watcher->GetQueryObjectui64v, watchGetQueryObject);
    watch("glDispatchCompute", watcher->DispatchCompute, watchDispatchCompute);
    watch("glDispatchComputeIndirect", watcher->DispatchComputeIndirect, watchDispatchComputeIndirect);
    watch("glDrawArrays", watcher->DrawArrays, watchDrawArrays);
    watch("glDrawArraysInstanced", watcher->DrawArraysInstanced, watchDrawArraysInstanced);
    watch("glDrawArraysIndirect", watcher->DrawArraysIndirect, watchDrawArraysIndirect);
    watch("glMultiDrawArrays", watcher->MultiDrawArrays, watchMultiDrawArrays);
    watch("glMultiDrawElements", watcher->MultiDrawElements, watchMultiDrawElements);
    watch("glPushDebugGroup", watcher->PushDebugGroup, watchPushDebugGroup);
    watch("glPopDebugGroup", watcher->PopDebugGroup, watchPopDebugGroup);
    return result;
  };
}

GlWork GlWatch::take() { return std::exchange(watcher_->work, {}); }

}  // namespace halfsilver::bench
