#include <gtest/gtest.h>

// Under the address sanitizer, leaks are looked for as soon as the tests are through, and not while threads run: the
// worker threads that come with OpenImageIO's dependencies start and end by themselves, and a thread met half way
// breaks the search (it is then not a leak that fails the test, but the leak sanitizer). The tests that read or write
// images of a kind that needs OpenImageIO are therefore checked for everything but leaks, and say so.
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
    if (othersRun()) std::cout << "leaks are not looked for: a library's threads are running\n";
    __lsan_do_leak_check();
  }
};

const testing::Environment* const kLeakCheck = testing::AddGlobalTestEnvironment(new LeakCheck);

}  // namespace
}  // namespace halfsilver

// The leak sanitizer asks this before it looks, and after a refusal it does not look again.
extern "C" int __lsan_is_turned_off() { return halfsilver::othersRun(); }
#endif
