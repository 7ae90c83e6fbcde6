#include <halfsilver/gl/profiler.h>

#include <algorithm>
#include <utility>

namespace halfsilver::gl {
namespace {

// No section of a frame takes longer; some drivers now and then answer with garbage.
constexpr double kAbsurdMilliseconds = 3600.0 * 1000.0;

}  // namespace

Profiler::~Profiler() {
  discard();
  if (!free_.empty()) api_->DeleteQueries(static_cast<GLsizei>(free_.size()), free_.data());
}

Profiler::Profiler(Profiler&& other) noexcept
    : api_(other.api_), entries_(std::exchange(other.entries_, {})), free_(std::exchange(other.free_, {})) {}

Profiler& Profiler::operator=(Profiler&& other) noexcept {
  std::swap(api_, other.api_);
  std::swap(entries_, other.entries_);
  std::swap(free_, other.free_);
  return *this;
}

GLuint Profiler::stamp() {
  if (free_.empty()) {
    free_.resize(16);
    api_->GenQueries(static_cast<GLsizei>(free_.size()), free_.data());
  }
  const GLuint query = free_.back();
  free_.pop_back();
  api_->QueryCounter(query, GL_TIMESTAMP);
  // Software rasterizers queue the stamp with the next draw but run a dispatch at once.
  if (api_->software) api_->Flush();
  return query;
}

Profiler::Scope::Scope(Profiler& profiler, std::string_view name)
    : profiler_(profiler), index_(profiler.entries_.size()) {
  profiler_.api_->PushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, static_cast<GLsizei>(name.size()), name.data());
  profiler_.entries_.push_back({std::string(name), profiler_.stamp(), 0, 0});
}

Profiler::Scope::~Scope() {
  profiler_.entries_[index_].end = profiler_.stamp();
  profiler_.api_->PopDebugGroup();
}

Profiler::HostScope::HostScope(Profiler& profiler, std::string_view name)
    : profiler_(profiler), index_(profiler.entries_.size()) {
  profiler_.api_->Finish();
  profiler_.entries_.push_back({std::string(name), 0, 0, 0});
  begin_ = std::chrono::steady_clock::now();
}

Profiler::HostScope::~HostScope() {
  profiler_.entries_[index_].hostMilliseconds =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin_).count();
}

void Profiler::discard() {
  for (const Entry& entry : entries_)
    if (entry.begin != 0) free_.insert(free_.end(), {entry.begin, entry.end});
  entries_.clear();
}

bool Profiler::arrived(GLuint query) const {
  GLuint64 available = GL_FALSE;
  api_->GetQueryObjectui64v(query, GL_QUERY_RESULT_AVAILABLE, &available);
  return available == GL_TRUE;
}

bool Profiler::ready() const {
  return std::all_of(entries_.begin(), entries_.end(), [this](const Entry& entry) {
    return entry.begin == 0 || (entry.end != 0 && arrived(entry.begin) && arrived(entry.end));
  });
}

double Profiler::elapsed(const Entry& entry) {
  if (entry.begin == 0) return entry.hostMilliseconds;
  GLuint64 begin = 0, end = 0;
  api_->GetQueryObjectui64v(entry.begin, GL_QUERY_RESULT, &begin);
  api_->GetQueryObjectui64v(entry.end, GL_QUERY_RESULT, &end);
  free_.push_back(entry.begin);
  free_.push_back(entry.end);
  return end >= begin ? static_cast<double>(end - begin) * 1e-6 : -1;
}

std::vector<SectionTime> Profiler::collect() {
  std::vector<SectionTime> times;
  for (const Entry& entry : entries_) {
    const double milliseconds = elapsed(entry);
    const bool absurd = milliseconds < 0 || milliseconds > kAbsurdMilliseconds;
    const auto known =
        std::find_if(times.begin(), times.end(), [&](const SectionTime& time) { return time.name == entry.name; });
    if (known == times.end())
      times.push_back({entry.name, absurd ? -1 : milliseconds});
    else if (absurd || known->milliseconds < 0)
      known->milliseconds = -1;
    else
      known->milliseconds += milliseconds;
  }
  entries_.clear();
  return times;
}

}  // namespace halfsilver::gl
