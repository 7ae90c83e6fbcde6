#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include <halfsilver/gl/api.h>

namespace halfsilver::bench {

// What a program asked of GL.
struct GlWork {
  std::uint64_t dispatches = 0, draws = 0;  // calls; one that draws many ranges is one
  std::uint64_t waits = 0;                  // calls that let the host wait for the GPU
  // Milliseconds of all of the process's threads between the begin and the end of a debug group, by its name. On a
  // software rasterizer, which runs a dispatch at once, that is what the dispatch cost.
  std::map<std::string, double> cpu;
};

// Watches the calls of functions that are loaded through its getProcAddress(). One at a time.
class GlWatch {
 public:
  explicit GlWatch(const gl::GetProcAddress& getProcAddress);
  ~GlWatch();
  GlWatch(const GlWatch&) = delete;
  GlWatch& operator=(const GlWatch&) = delete;

  gl::GetProcAddress getProcAddress() const;
  // Since the last call.
  GlWork take();

  struct Watcher;

 private:
  std::unique_ptr<Watcher> watcher_;
};

}  // namespace halfsilver::bench
