#include "apps/demo/outputs.h"

#include <halfsilver/io.h>

namespace halfsilver::demo {

RunOutputs::RunOutputs(const Request& request) {
  if (!request.screenshot.empty()) screenshot_.emplace(request.screenshot);
  if (!request.stats.empty()) stats_.emplace(request.stats);
}

void RunOutputs::add(const FrameFigures& figures) {
  if (stats_) lines_ += toLine(figures);
}

void RunOutputs::commit(const Size& size, std::span<const std::uint8_t> lastPicture) {
  if (screenshot_) screenshot_->write(encodePng(size.width, size.height, lastPicture));
  if (stats_) stats_->write(lines_);
  if (stats_) stats_->commit();
  if (screenshot_) screenshot_->commit();
}

}  // namespace halfsilver::demo
