#include <gtest/gtest.h>

// Under the address sanitizer, leaks are checked right after the tests, but not while other threads run: the worker
// threads of OpenImageIO's dependencies start and end on their own, and a thread caught halfway breaks the check itself
// (the leak sanitizer then fails, without a leak). Tests of images that need OpenImageIO are therefore checked for
// everything but leaks, and say so.
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define __SANITIZE_ADDRESS__  // as GCC says it
#endif
#endif
#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>
#include <filesystem>
#include <iostream>
#include <iterator>

namespace halfsilver {
namespace {

bool othersRun() {
  const std::filesystem::directory_iterator threads("/proc/self/task");
  return std::distance(begin(threads), end(threads)) > 1;
}

class LeakCheck : public testing::Environment {
 public:
  void TearDown() override {
    if (othersRun()) std::cout << "leaks are not checked: a library's threads are running\n";
    __lsan_do_leak_check();
  }
};

const testing::Environment* const kLeakCheck = testing::AddGlobalTestEnvironment(new LeakCheck);

}  // namespace
}  // namespace halfsilver

// The leak sanitizer asks this before it checks; once refused, it does not check again.
extern "C" int __lsan_is_turned_off() { return halfsilver::othersRun(); }
#endif
