#include <gtest/gtest.h>

// Under the address sanitizer, leaks are looked for as soon as the tests are through, while the worker threads that
// libraries started (OpenImageIO's own and those of what it brings) still sleep. The check that is made by itself at
// exit finds them half ended, and now and then fails on that.
#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>

namespace halfsilver {
namespace {

class LeakCheck : public testing::Environment {
 public:
  void TearDown() override { __lsan_do_leak_check(); }
};

const testing::Environment* const kLeakCheck = testing::AddGlobalTestEnvironment(new LeakCheck);

}  // namespace
}  // namespace halfsilver
#endif
