#pragma once

#include <map>
#include <utility>

#include "bench/harness/workbench.h"

namespace halfsilver::bench {

// The reference's frames. Those of one scene are kept, as many methods are compared with them.
class Truth {
 public:
  struct Frame {
    Image layers;   // see Renderer::readLayers()
    Image picture;  // see Workbench::picture()
  };

  explicit Truth(Workbench& bench) : bench_(&bench) {}

  // Draws if needed: the workbench's last frame is then the reference's. Valid until another scene is asked for.
  // Throws Error (usage) if the project is built without Embree.
  const Frame& of(const BenchScene& scene, SelectMode mode, int bounces = 1);

 private:
  Workbench* bench_;
  const BenchScene* scene_ = nullptr;
  std::map<std::pair<SelectMode, int>, Frame> frames_;
};

}  // namespace halfsilver::bench
