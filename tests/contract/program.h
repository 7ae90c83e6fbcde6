#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include <halfsilver/io.h>
#include "temporary_folder.h"

// Runs the built program as a user would, in a folder of its own.
namespace halfsilver {

struct ProgramResult {
  int exitCode = -1;
  std::string out, err;
};

// `arguments` as a shell takes them; `environment` as "NAME=value " before the command.
ProgramResult runProgramIn(const TemporaryFolder& folder, const std::string& arguments,
                           const std::string& environment = "");

// Names in the folder, sorted, without those that runProgramIn makes.
std::vector<std::string> filesIn(const TemporaryFolder& folder);

std::string readText(const std::filesystem::path& file);
nlohmann::json readJson(const std::filesystem::path& file);

// A quick picture of the built-in sphere: small, with a coarse structure and plain shadows.
inline const std::string kQuickSphere =
    "render builtin:sphere --size 64x36 --set shadow.resolution=64 --set shadow.sky_directions=0 "
    "--set voxels.resolution=16 --set abuffer.resolution=64 ";

// Writes wall.gltf and its buffer: one material "paint" (double-sided), one triangle in the plane z = 0 around
// (east, 0, 0), 200 m wide, and a camera "near" 5 m before it.
void writeWall(const TemporaryFolder& folder, double east = 0);

// One value of a layer.
float valueAt(const Image& image, const std::string& channel, int x, int y);

}  // namespace halfsilver
