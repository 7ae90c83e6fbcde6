#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

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

// A device, and how to make a context on it; throws Error (noContext) that says what is missing.
struct ContextWay {
  ContextKind kind;
  std::string name;
  std::function<std::unique_ptr<Context::Backend>()> make;
};

// Throws Error (noContext) if there are none.
std::vector<ContextWay> eglWays(const ContextOptions& options);
ContextWay osmesaWay(const ContextOptions& options);

}  // namespace halfsilver
