#include "bench/report/text.h"

#include <cstdio>

namespace halfsilver::bench {

std::string number(double value, int digits) {
  char text[64];
  std::snprintf(text, sizeof(text), "%.*f", digits, value);
  return text;
}

std::string percent(double share, int digits) { return number(100 * share, digits) + " %"; }
std::string megabytes(double bytes) { return number(bytes / 1e6, bytes < 1e7 ? 2 : 1); }
std::string ratioPercent(double part, double whole) { return whole > 0 ? percent(part / whole) : ""; }

}  // namespace halfsilver::bench
