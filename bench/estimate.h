#pragma once

#include <string>

namespace halfsilver::bench {

// How long the rest will take, from what has been done. Work is in any unit that grows with the time it takes.
class Estimate {
 public:
  void plan(double work) { planned_ += work; }
  void done(double work, double seconds);
  // "about 3 min left"; empty before anything is done.
  std::string left() const;

 private:
  double planned_ = 0, done_ = 0, seconds_ = 0;
};

}  // namespace halfsilver::bench
