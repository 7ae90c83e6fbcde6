#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

// Which of several measured settings are worth having. Lower is better in all three figures.
namespace halfsilver {

struct Cost {
  double milliseconds = 0;
  std::uint64_t bytes = 0;
  double error = 0;  // 0..1
};

// Indices of the points that no other point beats, that is, is at least as good in time, memory and error and better in
// one of them. Equal points are all kept. Sorted by time, then memory, error and index.
std::vector<std::size_t> paretoFront(std::span<const Cost> points);

// The fastest point with at most this error; among equally fast ones the smallest, then the first. Nothing if all have
// a larger error.
std::optional<std::size_t> fastestWithin(std::span<const Cost> points, double maxError);

// Whether a point is beaten by more than timer noise: another has no more memory and error, and takes at most half the
// time.
bool clearlyBeaten(const Cost& point, std::span<const Cost> others);

}  // namespace halfsilver
