#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <halfsilver/products.h>
#include "gl/program.h"

namespace halfsilver {

// A compute program that samples material textures, made for as many buckets as a scene has when it is first used with
// such a scene: software rasterizers pay for every bucket that a program knows, and for sheen and anisotropy (LOBES).
class SurfacePrograms {
 public:
  SurfacePrograms(const gl::Api& api, std::string_view file, std::vector<gl::Define> defines = {})
      : api_(&api), file_(file), defines_(std::move(defines)) {}

  const gl::Program& of(const GpuScene& scene) {
    const auto [place, isNew] = made_.try_emplace({scene.textures.size(), scene.lobes});
    if (isNew) {
      std::vector<gl::Define> defines = defines_;
      defines.push_back({"BUCKETS", std::to_string(scene.textures.size())});
      if (scene.lobes) defines.push_back({"LOBES"});
      place->second = gl::Program::compute(*api_, file_, defines);
    }
    return place->second;
  }

 private:
  const gl::Api* api_;
  std::string file_;
  std::vector<gl::Define> defines_;
  std::map<std::pair<std::size_t, bool>, gl::Program> made_;
};

}  // namespace halfsilver
