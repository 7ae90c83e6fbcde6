#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace halfsilver::testing {

// Path of the shared scene with this name: below $HALFSILVER_SCENES, or ../shared/scenes beside the project.
inline std::filesystem::path sharedScene(const std::string& name) {
  const char* folder = std::getenv("HALFSILVER_SCENES");
  if (folder) return std::filesystem::path(folder) / name;
  return std::filesystem::path(HALFSILVER_SOURCE_DIR) / ".." / "shared" / "scenes" / name;
}

}  // namespace halfsilver::testing

// Skips the test, with a message, if the path does not exist.
#define HALFSILVER_REQUIRE_SCENE(path) \
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "shared scene is absent: " << (path).string()
