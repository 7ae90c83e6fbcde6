#pragma once

#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <halfsilver/frame_view.h>
#include "gl/program.h"

namespace halfsilver {

// A compute program that samples material textures, made for as many buckets as a scene has when it is first used with
// such a scene: software rasterizers pay for every bucket that a program knows, for sheen and anisotropy (LOBES), and
// in frames that blend for coats (COATS) and what is seen through (TRANSMISSION).
class SurfacePrograms {
 public:
  SurfacePrograms(const gl::Api& api, std::string_view file, std::vector<gl::Define> defines = {})
      : api_(&api), file_(file), defines_(std::move(defines)) {}

  const gl::Program& of(const GpuScene& scene) { return of(scene, false, false); }
  const gl::Program& of(const FrameView& view) {
    return of(view.scene, view.frame.coats != 0, view.frame.transmission != 0);
  }

 private:
  const gl::Program& of(const GpuScene& scene, bool coats, bool transmission) {
    const auto [place, isNew] = made_.try_emplace({scene.textures.size(), scene.lobes, coats, transmission});
    if (isNew) {
      std::vector<gl::Define> defines = defines_;
      defines.push_back({"BUCKETS", std::to_string(scene.textures.size())});
      if (scene.lobes) defines.push_back({"LOBES"});
      if (coats) defines.push_back({"COATS"});
      if (transmission) defines.push_back({"TRANSMISSION"});
      place->second = gl::Program::compute(*api_, file_, defines);
    }
    return place->second;
  }

  const gl::Api* api_;
  std::string file_;
  std::vector<gl::Define> defines_;
  std::map<std::tuple<std::size_t, bool, bool, bool>, gl::Program> made_;
};

}  // namespace halfsilver
