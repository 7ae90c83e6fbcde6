#include "apps/demo_module.h"

#include <dlfcn.h>

#include <halfsilver/error.h>

namespace halfsilver {
namespace {

demo::Run* demoModule() {
  if constexpr (!HALFSILVER_DEMO)
    throw Error(ErrorKind::noContext, "demo: this program was built without it (HALFSILVER_DEMO=OFF)");
  void* module = dlopen(demo::kModule, RTLD_NOW | RTLD_LOCAL);
  void* function = module ? dlsym(module, demo::kRunFunction) : nullptr;
  if (!function) throw Error(ErrorKind::noContext, std::string("demo: ") + dlerror());
  return reinterpret_cast<demo::Run*>(function);
}

}  // namespace

void runDemo(const demo::Request& request) {
  demo::Outcome outcome;
  demoModule()(request, outcome);
  if (outcome.exitCode != 0) throw Error(static_cast<ErrorKind>(outcome.exitCode), outcome.message);
}

}  // namespace halfsilver
