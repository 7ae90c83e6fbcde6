#include "bench/gnuplot.h"

#include <cmath>
#include <sstream>

namespace halfsilver::bench {

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (static_cast<unsigned char>(c) >= ' ') result += c;
  }
  return result + '"';
}

std::vector<double> logarithmicTicks(double low, double high) {
  const bool few = high < 300 * low;
  const double rounding = 1e-6;
  std::vector<double> ticks;
  for (double decade = std::pow(10.0, std::floor(std::log10(low))); decade <= high * (1 + rounding); decade *= 10)
    for (const double step : {1.0, 2.0, 5.0})
      if (const double tick = step * decade;
          (few || step == 1.0) && tick >= low * (1 - rounding) && tick <= high * (1 + rounding))
        ticks.push_back(tick);
  return ticks;
}

std::string terminal(ChartFormat format, double width, double height) {
  std::ostringstream text;
  text << "set terminal " << (format == ChartFormat::svg ? "svg" : "pngcairo") << " noenhanced size " << width << ','
       << height << " background rgb \"white\" font \"sans,12\"\n";
  return text.str();
}

}  // namespace halfsilver::bench
