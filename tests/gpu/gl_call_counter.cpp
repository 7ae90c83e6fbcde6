#include "gpu/gl_call_counter.h"

#include <array>
#include <cstddef>
#include <utility>

namespace halfsilver::testing {
namespace {

enum Function : std::size_t {
#define HALFSILVER_GL_INDEX(type, name) k##name,
  HALFSILVER_GL_FUNCTIONS(HALFSILVER_GL_INDEX)
#undef HALFSILVER_GL_INDEX
      kFunctions
};

constexpr std::string_view kNames[] = {
#define HALFSILVER_GL_NAME(type, name) #name,
    HALFSILVER_GL_FUNCTIONS(HALFSILVER_GL_NAME)
#undef HALFSILVER_GL_NAME
};

// A GL function takes no context of the caller's, so its counter can only be here.
thread_local std::array<std::uint64_t, kFunctions> counts{};

template <std::size_t index, class Type>
struct Counted;

template <std::size_t index, class Result, class... Arguments>
struct Counted<index, Result (*)(Arguments...)> {
  static inline Result (*real)(Arguments...) = nullptr;
  static Result call(Arguments... arguments) {
    ++counts[index];
    return real(arguments...);
  }
};

}  // namespace

GlCallCounter::GlCallCounter(const gl::GetProcAddress& getProcAddress) : real_(getProcAddress) { reset(); }
GlCallCounter::~GlCallCounter() { reset(); }

gl::GetProcAddress GlCallCounter::getProcAddress() const {
  return [real = real_](const char* name) -> gl::Proc {
    const gl::Proc found = real(name);
    const std::string_view wanted(name);
#define HALFSILVER_GL_COUNT(type, function)                            \
  if (wanted == "gl" #function) {                                      \
    using Function = Counted<k##function, type>;                       \
    Function::real = reinterpret_cast<type>(found);                    \
    return found ? reinterpret_cast<gl::Proc>(Function::call) : found; \
  }
    HALFSILVER_GL_FUNCTIONS(HALFSILVER_GL_COUNT)
#undef HALFSILVER_GL_COUNT
    return found;
  };
}

void GlCallCounter::reset() { counts.fill(0); }

std::uint64_t GlCallCounter::all() const { return of(""); }

std::uint64_t GlCallCounter::of(std::string_view begin) const {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < kFunctions; ++i)
    if (kNames[i].starts_with(begin)) sum += counts[i];
  return sum;
}

}  // namespace halfsilver::testing
