#pragma once

#include <memory>
#include <string>
#include <vector>

#include <halfsilver/gl/api.h>

namespace halfsilver::testing {

// Watches the GL calls of a frame for state that a pass uses but somebody else has set. A pass is a debug group, as
// Profiler::section() makes one; of nested groups, the innermost. At each dispatch and draw it must have
// - chosen the program and bound all storage blocks, uniform blocks, textures and images that the program uses,
// - used no storage number for blocks of two names,
// - bound the buffer of an indirect dispatch or draw,
// - for a draw, set the framebuffer, the vertex array and all of gl::DrawState.
//
// What is loaded through getProcAddress() is watched, on this thread and while the audit lives. One at a time.
class BindingAudit {
 public:
  // `getProcAddress` is that of the current context.
  explicit BindingAudit(const gl::GetProcAddress& getProcAddress);
  ~BindingAudit();
  BindingAudit(const BindingAudit&) = delete;
  BindingAudit& operator=(const BindingAudit&) = delete;

  gl::GetProcAddress getProcAddress() const;

  // What was found, in sentences, each once and in the order of its first occurrence.
  const std::vector<std::string>& complaints() const;
  // Dispatches and draws of a pass, by the pass's name.
  std::size_t checks(const std::string& pass) const;

  struct Recorder;

 private:
  std::unique_ptr<Recorder> recorder_;
};

}  // namespace halfsilver::testing
