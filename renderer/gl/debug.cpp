#include "gl/debug.h"

#include <utility>

#include "gl/draw_state.h"

namespace halfsilver::gl {
namespace {

void APIENTRY collect(GLenum, GLenum type, GLuint, GLenum severity, GLsizei length, const GLchar* text,
                      const void* messages) {
  const DebugMessage message{type, severity, std::string(text, static_cast<std::size_t>(length))};
  if (message.error() || severity == GL_DEBUG_SEVERITY_MEDIUM)
    static_cast<std::vector<DebugMessage>*>(const_cast<void*>(messages))->push_back(message);
}

}  // namespace

DebugLog::DebugLog(const Api& api)
    : api_(&api),
      wasEnabled_(api.IsEnabled(GL_DEBUG_OUTPUT)),
      wasSynchronous_(api.IsEnabled(GL_DEBUG_OUTPUT_SYNCHRONOUS)) {
  // Synchronous, so that the callback runs on this thread and within the call that it speaks of.
  api.Enable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  api.Enable(GL_DEBUG_OUTPUT);
  api.DebugMessageCallback(collect, &messages_);
}

DebugLog::~DebugLog() {
  api_->DebugMessageCallback(nullptr, nullptr);
  setEnabled(*api_, GL_DEBUG_OUTPUT, wasEnabled_);
  setEnabled(*api_, GL_DEBUG_OUTPUT_SYNCHRONOUS, wasSynchronous_);
}

std::vector<DebugMessage> DebugLog::take() { return std::exchange(messages_, {}); }

}  // namespace halfsilver::gl
