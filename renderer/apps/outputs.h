#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <halfsilver/renderer.h>
#include "apps/offscreen.h"
#include "apps/statistics.h"
#include "io/atomic_file.h"

namespace halfsilver {

// Where `render` writes; empty: not wanted.
struct OutputPaths {
  std::string picture, stats, layers;

  std::vector<std::string> wanted() const;
};

// Throws Error (usage) for a kind of file that cannot be written or a path that is given twice.
void checkOutputs(const OutputPaths& paths);

// The output files of one picture: either all appear or none.
class Outputs {
 public:
  // Throws Error: as checkOutputs(), and failed if a file cannot be made.
  explicit Outputs(const OutputPaths& paths);

  // The frame that the renderer drew into the target last. Waits for the GPU. Returns the share of a PNG's pixels that
  // are white.
  double writePictures(const Renderer& renderer, const OffscreenTarget& target, double diagonal);
  void writeStatistics(const RunStatistics& statistics);
  // Every file is complete by now: all that is left is to rename them.
  void commit();

 private:
  std::optional<AtomicFile> picture_, stats_, layers_;
  bool linear_ = false;
};

}  // namespace halfsilver
