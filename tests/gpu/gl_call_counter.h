#pragma once

#include <cstdint>
#include <memory>
#include <string_view>

#include <halfsilver/gl/api.h>

namespace halfsilver::testing {

// Counts the GL calls that go through getProcAddress(), on this thread and while it lives. One at a time.
class GlCallCounter {
 public:
  // `getProcAddress` is that of the current context.
  explicit GlCallCounter(const gl::GetProcAddress& getProcAddress);
  ~GlCallCounter();
  GlCallCounter(const GlCallCounter&) = delete;
  GlCallCounter& operator=(const GlCallCounter&) = delete;

  gl::GetProcAddress getProcAddress() const;

  void reset();
  std::uint64_t all() const;
  // Of functions whose names, without "gl", begin so.
  std::uint64_t of(std::string_view begin) const;

 private:
  gl::GetProcAddress real_;
};

}  // namespace halfsilver::testing
