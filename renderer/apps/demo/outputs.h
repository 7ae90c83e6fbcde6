#pragma once

#include <fstream>
#include <optional>

#include "apps/demo/demo.h"
#include "apps/demo/frame_log.h"
#include "apps/offscreen.h"
#include "io/atomic_file.h"

namespace halfsilver::demo {

// The files of a run of --frames; they appear when it is complete.
class RunOutputs {
 public:
  explicit RunOutputs(const Request& request);  // throws Error (failed) if one cannot be made

  void add(const FrameFigures& figures);
  void commit(const Size& size, std::span<const std::uint8_t> lastPicture);

 private:
  std::optional<AtomicFile> screenshot_, stats_;
  std::string lines_;
};

}  // namespace halfsilver::demo
