// Links halfsilver::renderer alone, as an engine with its own context does. The engine has headers of its own under
// names that the library uses inside, on its include path; those must be the engine's.
#include <halfsilver/renderer.h>

#include <cstdio>

#include "gl/api.h"
#include "scene/scene.h"
#include "settings.h"

static_assert(engine::scene && engine::settings && engine::api);

int main() {
  const auto noFunctions = [](const char*) -> halfsilver::Renderer::Proc { return nullptr; };
  try {
    halfsilver::Renderer renderer(noFunctions);
  } catch (const std::exception& error) {
    std::puts(error.what());  // no context, so the first function is missing
    return 0;
  }
  return 1;
}
