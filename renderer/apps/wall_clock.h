#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace halfsilver {

// Wall-clock time from the process's start, split into named laps.
class WallClock {
 public:
  WallClock();  // the lap "start" ends here: what loading the program took
  // Ends a lap; equal names are summed.
  void lap(const std::string& name);
  // Milliseconds, in order of first use; "total" is the last.
  std::vector<std::pair<std::string, double>> milliseconds() const;

 private:
  std::vector<std::pair<std::string, double>> laps_;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace halfsilver
