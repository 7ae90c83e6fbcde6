#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gl/api.h"

namespace halfsilver::gl {

struct SectionTime {
  std::string name;
  double milliseconds = 0;  // negative: the driver's answer was absurd and has been rejected
};

// Named GPU sections: one name feeds the timer, the debug group and the statistics. Sections may nest; a name that
// occurs twice in a frame is summed.
class Profiler {
 public:
  explicit Profiler(const Api& api) : api_(&api) {}
  ~Profiler();
  Profiler(const Profiler&) = delete;
  Profiler& operator=(const Profiler&) = delete;

  class Scope {
   public:
    Scope(Profiler& profiler, std::string_view name);
    ~Scope();
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    Profiler& profiler_;
    std::size_t index_;
  };
  // Ends with the returned object's lifetime.
  [[nodiscard]] Scope section(std::string_view name) { return Scope(*this, name); }

  // Times of all sections since the last call, in order of their first begin. Waits for the GPU.
  std::vector<SectionTime> collect();

 private:
  GLuint stamp();

  struct Entry {
    std::string name;
    GLuint begin = 0, end = 0;
  };
  const Api* api_;
  std::vector<Entry> entries_;
  std::vector<GLuint> free_;
};

}  // namespace halfsilver::gl
