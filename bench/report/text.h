#pragma once

#include <string>

// Numbers as text.
namespace halfsilver::bench {

std::string number(double value, int digits);         // after the point
std::string percent(double share, int digits = 1);    // "12.5 %"
std::string megabytes(double bytes);                  // 10^6 bytes
std::string ratioPercent(double part, double whole);  // empty if `whole` is 0

}  // namespace halfsilver::bench
