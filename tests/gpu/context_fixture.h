#pragma once

#include <gtest/gtest.h>

#include <string>

#include <halfsilver/context.h>
#include <halfsilver/gl/api.h>
#include "gl/debug.h"

namespace halfsilver::testing {

// Which context the GPU tests run on: $HALFSILVER_CONTEXT (auto, egl, osmesa), auto where it is not set.
ContextKind contextUnderTest();

// A current debug context with its functions. The test fails on every GL error that it does not take out of `log`.
class ContextTest : public ::testing::Test {
 protected:
  explicit ContextTest(ContextKind kind = contextUnderTest());
  void TearDown() override;

  // Texts of the errors since the last call, which the test expects and so takes out.
  std::vector<std::string> takeErrors();

  Context context;
  gl::Api api;
  gl::DebugLog log;
};

}  // namespace halfsilver::testing
