// Links halfsilver::renderer alone, as an engine with its own context does.
#include <halfsilver/renderer.h>

#include <cstdio>

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
