#pragma once

namespace halfsilver {

// The whole command line: parses, runs one command and returns the exit code (0 done, 1 failed, 2 wrong usage, 3 bad
// input, 4 no usable GL context). An error is one line on stderr.
int runProgram(int argc, const char* const* argv);

const char* version();  // "0.1.0"

}  // namespace halfsilver
