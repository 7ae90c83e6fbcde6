#include "apps/progress.h"

#include <unistd.h>

#include <iostream>

namespace halfsilver {
namespace {

constexpr const char* kClearLine = "\r\033[K";

}  // namespace

Progress::Progress() : terminal_(::isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() { clear(); }

void Progress::show(const std::string& text) {
  if (!terminal_) return;
  std::cerr << kClearLine << text << std::flush;
  shown_ = true;
}

void Progress::clear() {
  if (shown_) std::cerr << kClearLine << std::flush;
  shown_ = false;
}

}  // namespace halfsilver
