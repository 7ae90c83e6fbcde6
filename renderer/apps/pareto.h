#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

// Which of several measured settings are worth having. Less is better in all three.
namespace halfsilver {

struct Cost {
  double milliseconds = 0;
  std::uint64_t bytes = 0;
  double error = 0;  // 0..1
};

// The points that no other beats: none is at least as good in time, memory and error and better in one of them. Equal
// points stay together. Indices, by time, then memory, error and index.
std::vector<std::size_t> paretoFront(std::span<const Cost> points);

// The fastest point with at most this error; of equally fast ones the smaller, then the first. Nothing where all have
// more.
std::optional<std::size_t> fastestWithin(std::span<const Cost> points, double maxError);

// Whether a point is beaten beyond the noise of timers: another has no more memory and error, and takes at most half
// the time.
bool clearlyBeaten(const Cost& point, std::span<const Cost> others);

}  // namespace halfsilver
