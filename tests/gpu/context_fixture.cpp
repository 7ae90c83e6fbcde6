#include "gpu/context_fixture.h"

#include <cstdlib>
#include <string_view>

namespace halfsilver::testing {

ContextKind contextUnderTest() {
  const char* value = std::getenv("HALFSILVER_CONTEXT");
  const std::string_view name = value ? value : "auto";
  if (name == "egl") return ContextKind::egl;
  if (name == "osmesa") return ContextKind::osmesa;
  return ContextKind::automatic;
}

ContextTest::ContextTest(ContextKind kind)
    : context(makeContext(kind, {.debug = true, .eglLibrary = {}, .osmesaLibrary = {}})),
      api(gl::Api::load(context.getProcAddress())),
      log(api) {}

void ContextTest::TearDown() {
  for (const std::string& text : takeErrors()) ADD_FAILURE() << "GL error: " << text;
}

std::vector<std::string> ContextTest::takeErrors() {
  std::vector<std::string> errors;
  for (const gl::DebugMessage& message : log.take())
    if (message.error()) errors.push_back(message.text);
  // Not every driver reports every error to the callback.
  GLenum code = GL_NO_ERROR;
  while ((code = api.GetError()) != GL_NO_ERROR)
    if (errors.empty()) errors.push_back("glGetError returns " + std::to_string(code));
  return errors;
}

}  // namespace halfsilver::testing
