#include "bench/gnuplot.h"

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

std::string terminal(ChartFormat format, double width, double height) {
  std::ostringstream text;
  text << "set terminal " << (format == ChartFormat::svg ? "svg" : "pngcairo") << " noenhanced size " << width << ','
       << height << " background rgb \"white\" font \"sans,12\"\n";
  return text.str();
}

}  // namespace halfsilver::bench
