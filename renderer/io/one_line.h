#pragma once

#include <algorithm>
#include <string>

namespace halfsilver {

// A message without the control characters that it quotes from a file.
inline std::string oneLine(std::string message) {
  std::replace_if(
      message.begin(), message.end(), [](unsigned char c) { return c < 32 || c == 127; }, ' ');
  return message;
}

}  // namespace halfsilver
