#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <halfsilver/model.h>

namespace halfsilver {

// Names of the scenes made in code, without the "builtin:" prefix and without those below.
std::vector<std::string> builtinNames();

// Names of small ones that show what rays do beside mirrors: glass, coats, area lights, light sent on by surfaces.
std::vector<std::string> effectSceneNames();

// Makes a scene, bit-identical on every machine. Throws Error (badInput) for an unknown name and lists the known ones.
Model makeBuiltin(std::string_view name);

// Built-in scenes on which tracing methods fail, each the smallest that breaks one of them and named after the cause.
// makeBuiltin() knows their names.

// What changes from one frame of a slow motion to the next.
struct SlowMove {
  glm::vec3 camera{0};  // how far the eye moves, in meters
  glm::vec3 object{0};  // how far everything of the material "moving" moves, in meters
  float growth = 1;     // factor by which the same grows about its center
  double seconds = 0;   // of the scene's animations, which all play
  // Moves vertices of the same, which are as they are at rest (frame 0), to a frame; null: nothing.
  void (*shape)(std::span<Vertex> vertices, int frame) = nullptr;
};

struct FailureScene {
  std::string_view name;
  std::string_view cause;  // what a method has to cope with, in plain words
  Model (*make)();
  SlowMove move;
  int bounces = 1;  // reflections along a path needed to show it
};

std::span<const FailureScene> failureScenes();

}  // namespace halfsilver
