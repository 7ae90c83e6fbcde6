#include <halfsilver/context.h>

#include <utility>

#include <halfsilver/error.h>
#include "context/backend.h"

namespace halfsilver {

Context::Context(std::unique_ptr<Backend> backend) : backend_(std::move(backend)) {}
Context::~Context() = default;
Context::Context(Context&&) noexcept = default;
Context& Context::operator=(Context&&) noexcept = default;

const char* Context::name() const { return backend_->name(); }
std::function<Context::Proc(const char*)> Context::getProcAddress() const { return backend_->getProcAddress(); }
void Context::makeCurrent() { backend_->makeCurrent(); }
void Context::release() { backend_->release(); }

Context makeContext(ContextKind kind, const ContextOptions& options) {
  std::string lacks;
  if (kind != ContextKind::osmesa) {
    try {
      return Context(makeEgl(options));
    } catch (const Error& error) {
      lacks = std::string("EGL: ") + error.what();
    }
  }
  if (kind != ContextKind::egl) {
    try {
      return Context(makeOsmesa(options));
    } catch (const Error& error) {
      lacks += (lacks.empty() ? "" : "; ") + (std::string("OSMesa: ") + error.what());
    }
  }
  throw Error(ErrorKind::noContext, "no OpenGL 4.5 core context: " + lacks);
}

}  // namespace halfsilver
