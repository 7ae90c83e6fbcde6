#pragma once

#include <filesystem>
#include <string>

#include <halfsilver/pose.h>

// Models that move, of the tests of poses.
namespace halfsilver::testing {

inline constexpr double kTimes[] = {0, 0.13, 0.37, 0.61, 1};  // of the longest animation

// All that plays together, at a time.
PoseState poseOf(const Model& model, double seconds);
double durationOf(const Model& model);

// A glTF file of the shared cases.
std::filesystem::path sharedCase(const std::string& name);

// Two instances of a triangle each, of which node 1 moves the second; a third of two joints.
Model rigged(const glm::dvec3& restOffset = glm::dvec3(0));

}  // namespace halfsilver::testing
