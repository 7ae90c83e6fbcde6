#pragma once

#include <string>

namespace halfsilver::bench {

// Predicts the remaining time from the time spent so far. Work is in any unit proportional to time.
class Estimate {
 public:
  void plan(double work) { planned_ += work; }
  void done(double work, double seconds);
  // "about 3 min left"; empty until something is done.
  std::string left() const;

 private:
  double planned_ = 0, done_ = 0, seconds_ = 0;
};

}  // namespace halfsilver::bench
