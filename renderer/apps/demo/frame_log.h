#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include <halfsilver/renderer.h>

namespace halfsilver::demo {

// What a frame took, and how its picture was made.
struct FrameFigures {
  int frame = 0;
  double wallMilliseconds = 0;
  double scale = 1;           // of the resolution, chosen by the controller
  double tracedShare = 1;     // of the reflecting pixels
  int width = 0, height = 0;  // of the picture
  FrameReport report;
  std::vector<std::string> status;  // of the play
  bool drawn = true;                // false: the picture had all its samples, and stays
};

// A line of JSON: coverage, rays, stage times, bytes of the structure and in all, scale, overflow.
std::string toLine(const FrameFigures& figures);

// The last times of each stage, for plots.
class FrameLog {
 public:
  static constexpr std::size_t kFrames = 120;

  void add(const FrameFigures& figures);
  const FrameFigures& last() const { return last_; }

  struct Series {
    std::array<float, kFrames> milliseconds{};  // a ring; `first` is the oldest
    float max = 0;                              // of the frames in the ring
  };
  const std::map<std::string, Series>& stages() const { return stages_; }
  int first() const { return static_cast<int>(next_); }

 private:
  FrameFigures last_;
  std::map<std::string, Series> stages_;
  std::size_t next_ = 0;
};

}  // namespace halfsilver::demo
