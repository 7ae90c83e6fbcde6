#pragma once

#include <map>
#include <utility>

#include "bench/workbench.h"

namespace halfsilver::bench {

// What the reference draws. The frames of one scene are kept: many methods are compared with them.
class Truth {
 public:
  struct Frame {
    Image layers;   // see Renderer::readLayers()
    Image picture;  // see Workbench::picture()
  };

  explicit Truth(Workbench& bench) : bench_(&bench) {}

  // Draws where it must: the last frame of the workbench is then the reference's. Good until another scene is asked
  // for. Throws Error (usage) where the project is built without Embree.
  const Frame& of(const BenchScene& scene, SelectMode mode, int bounces = 1);

 private:
  Workbench* bench_;
  const BenchScene* scene_ = nullptr;
  std::map<std::pair<SelectMode, int>, Frame> frames_;
};

}  // namespace halfsilver::bench
