#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

#include <halfsilver/gl/api.h>

namespace halfsilver::gl {

struct SectionTime {
  std::string name;
  double milliseconds = 0;  // negative: the driver's answer was absurd and was rejected
};

// Named GPU sections: one name feeds the timer, the debug group and the statistics. Sections may nest; the times of a
// name that occurs twice are summed.
//
// The sections belong to this object alone, so a renderer with several frames in flight keeps one profiler for each:
// it collects the times of an earlier frame once they are ready, while the next frame's are being recorded. Move-only;
// must not be moved while a section is open.
class Profiler {
 public:
  explicit Profiler(const Api& api) : api_(&api) {}
  ~Profiler();
  Profiler(Profiler&& other) noexcept;
  Profiler& operator=(Profiler&& other) noexcept;
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

  // The same for work on the host: waits for the GPU, then takes the host's clock.
  class HostScope {
   public:
    HostScope(Profiler& profiler, std::string_view name);
    ~HostScope();
    HostScope(const HostScope&) = delete;
    HostScope& operator=(const HostScope&) = delete;

   private:
    Profiler& profiler_;
    std::size_t index_;
    std::chrono::steady_clock::time_point begin_;
  };
  [[nodiscard]] HostScope hostSection(std::string_view name) { return HostScope(*this, name); }

  // The same for work that other threads did beside the GPU and that took so long. It may overlap other sections.
  void add(std::string_view name, double milliseconds) { entries_.push_back({std::string(name), 0, 0, milliseconds}); }

  // Forgets the sections since the last collect() without waiting for them.
  void discard();

  // Whether all sections since the last collect() have ended and their times have arrived. Never waits.
  bool ready() const;

  // Times of all sections since the last call, in order of their first begin. Waits for the GPU unless ready().
  std::vector<SectionTime> collect();

 private:
  struct Entry {
    std::string name;
    GLuint begin = 0, end = 0;  // queries; 0 for work on the host
    double hostMilliseconds = 0;
  };
  GLuint stamp();
  bool arrived(GLuint query) const;
  double elapsed(const Entry& entry);

  const Api* api_;
  std::vector<Entry> entries_;
  std::vector<GLuint> free_;
};

}  // namespace halfsilver::gl
