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
// such a scene: software rasterizers pay for every bucket that a program knows.
class SurfacePrograms {
 public:
  SurfacePrograms(const gl::Api& api, std::string_view file, std::vector<gl::Define> defines = {})
      : api_(&api), file_(file), defines_(std::move(defines)) {}

  const gl::Program& of(const GpuScene& scene) {
    const auto [place, isNew] = byBuckets_.try_emplace(scene.textures.size());
    if (isNew) {
      std::vector<gl::Define> defines = defines_;
      defines.push_back({"BUCKETS", std::to_string(place->first)});
      place->second = gl::Program::compute(*api_, file_, defines);
    }
    return place->second;
  }

 private:
  const gl::Api* api_;
  std::string file_;
  std::vector<gl::Define> defines_;
  std::map<std::size_t, gl::Program> byBuckets_;
};

}  // namespace halfsilver
