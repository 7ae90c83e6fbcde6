#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>

#include <halfsilver/error.h>

namespace halfsilver::fuzz {

// Ends the run, as a crash does: libFuzzer then keeps the input.
inline void expect(bool holds, const std::string& what) {
  if (holds) return;
  std::fprintf(stderr, "%s\n", what.c_str());
  std::abort();
}

// What is unusable is refused as bad input, with one line that begins with the file's name.
inline void expectRefusal(const Error& error, const std::string& file) {
  const std::string line = error.what();
  expect(error.kind() == ErrorKind::badInput, "not bad input: " + line);
  expect(line.starts_with(file + ":"), "without the file's name: " + line);
  expect(line.find('\n') == std::string::npos, "more than a line: " + line);
}

}  // namespace halfsilver::fuzz
