#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <halfsilver/model.h>
#include <halfsilver/settings.h>
#include "bench/harness/request.h"

namespace halfsilver::bench {

struct BenchScene {
  std::string name;
  Model model;
  Camera camera;
  std::vector<std::string> mirrors;  // MATERIAL=REFLECTIVITY
  double diagonal = 0;               // meters
};

// All scenes of a request, with its mirrors and cameras, loaded up front: a bad one must not show after an hour's work.
// Warnings about them go to stderr.
std::vector<BenchScene> loadScenes(const Request& request);

// A preset's settings for a scene of so many triangles. The papers' methods get the papers' voxels: 64^3, large scenes
// 256^3 (Kastrati & Goswami 2017, section 4.1; Hu et al. 2014, figure 11), and quick runs fewer, with fewer texels;
// large scenes get at most 1024^2 texels. Throws Error (usage) for an unknown preset.
Settings presetSettings(const std::string& preset, bool quick, std::size_t triangles);

}  // namespace halfsilver::bench
