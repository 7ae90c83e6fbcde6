#include "apps/wall_clock.h"

#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <fstream>
#include <sstream>

namespace halfsilver {
namespace {

// Seconds since the kernel started this process, in clock ticks of 10 ms; 0 if unknown.
double processAge() {
  std::ifstream stat("/proc/self/stat");
  std::string line;
  std::getline(stat, line);
  // The second field, the program's name in parentheses, may contain spaces.
  std::istringstream fields(line.substr(std::min(line.size(), line.rfind(')') + 1)));
  std::string skipped;
  for (int field = 3; field < 22; ++field) fields >> skipped;
  double ticks = 0;
  timespec now{};
  if (!(fields >> ticks) || clock_gettime(CLOCK_BOOTTIME, &now) != 0) return 0;
  const double started = ticks / static_cast<double>(sysconf(_SC_CLK_TCK));
  return std::max(0.0, static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec) - started);
}

}  // namespace

WallClock::WallClock() : laps_{{"start", 1000 * processAge()}}, last_(std::chrono::steady_clock::now()) {}

void WallClock::lap(const std::string& name) {
  const auto now = std::chrono::steady_clock::now();
  const double elapsed = std::chrono::duration<double, std::milli>(now - last_).count();
  last_ = now;
  const auto known = std::find_if(laps_.begin(), laps_.end(), [&](const auto& entry) { return entry.first == name; });
  if (known != laps_.end())
    known->second += elapsed;
  else
    laps_.emplace_back(name, elapsed);
}

std::vector<std::pair<std::string, double>> WallClock::milliseconds() const {
  auto result = laps_;
  double total = 0;
  for (const auto& [name, elapsed] : laps_) total += elapsed;
  result.emplace_back("total", total);
  return result;
}

}  // namespace halfsilver
