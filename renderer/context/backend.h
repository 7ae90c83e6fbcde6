#pragma once

#include <memory>

#include <halfsilver/context.h>

namespace halfsilver {

// One way to create a context, which is current after construction.
class Context::Backend {
 public:
  virtual ~Backend() = default;
  virtual const char* name() const = 0;
  virtual Proc (*getProcAddress() const)(const char*) = 0;
  virtual void makeCurrent() = 0;
  virtual void release() = 0;
};

// Both throw Error (noContext) that says what is missing.
std::unique_ptr<Context::Backend> makeEgl(const ContextOptions& options);
std::unique_ptr<Context::Backend> makeOsmesa(const ContextOptions& options);

}  // namespace halfsilver
