#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <halfsilver/model.h>

namespace halfsilver {

// Names of the scenes made in code, without the "builtin:" prefix; failureScenes() are apart.
std::vector<std::string> builtinNames();

// The scene, deterministic on every machine. Throws Error (badInput) for an unknown name, listing the known ones.
Model makeBuiltin(std::string_view name);

// Built-in scenes on which methods of tracing fail, each the smallest that breaks one of them, named for its cause.
// Their names are known to makeBuiltin().

// What changes from one frame of a slow move to the next.
struct SlowMove {
  glm::vec3 camera{0};  // metres that the eye moves by
  glm::vec3 object{0};  // metres that what is made of the material "moving" moves by
  float growth = 1;     // factor by which that grows about its middle
};

struct FailureScene {
  std::string_view name;
  std::string_view cause;  // what a method must cope with, in plain words
  Model (*make)();
  SlowMove move;
  int bounces = 1;  // reflections along a path that show it
};

std::span<const FailureScene> failureScenes();

}  // namespace halfsilver
