#pragma once

#include <string>

#include <halfsilver/gl/api.h>

namespace halfsilver::testing {

// A device whose storage blocks hold little: a picture of 256 x 192 pixels is to it what one of 4K is to others.
inline constexpr GLint64 kSmallBlock = 1 << 20;

inline gl::GetProcAddress withSmallBlocks(const gl::GetProcAddress& proc) {
  static thread_local PFNGLGETINTEGER64VPROC getInteger64v;  // GL's functions have no room for an object
  getInteger64v = reinterpret_cast<PFNGLGETINTEGER64VPROC>(proc("glGetInteger64v"));
  struct Small {
    static void APIENTRY getInteger(GLenum name, GLint64* value) {
      getInteger64v(name, value);
      if (name == GL_MAX_SHADER_STORAGE_BLOCK_SIZE) *value = kSmallBlock;
    }
  };
  return [proc](const char* name) {
    return name == std::string("glGetInteger64v") ? reinterpret_cast<gl::Proc>(&Small::getInteger) : proc(name);
  };
}

}  // namespace halfsilver::testing
