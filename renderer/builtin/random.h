#pragma once

#include <cstdint>

namespace halfsilver {

// Integer hash (xor-shift and multiply finalizer): the same on every machine, unlike the standard distributions.
constexpr std::uint32_t hash(std::uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  x ^= x >> 16;
  return x;
}

// 0 <= result < 1, from the upper 24 bits.
constexpr double unitInterval(std::uint32_t bits) { return static_cast<double>(bits >> 8) / 16777216.0; }

// Two numbers in one call's arguments would come in an order that the compiler chooses.
class Random {
 public:
  explicit constexpr Random(std::uint32_t seed) : state_(hash(seed)) {}
  constexpr double unit() { return unitInterval(state_ = hash(state_ + 0x9e3779b9u)); }
  constexpr double between(double low, double high) { return low + (high - low) * unit(); }

 private:
  std::uint32_t state_;
};

}  // namespace halfsilver
