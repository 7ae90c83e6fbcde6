#pragma once

#include <stdexcept>
#include <string>

namespace halfsilver {

// What went wrong. The values are the exit codes of the command line.
enum class ErrorKind {
  failed = 1,    // a valid request could not be carried out (disk full, GPU out of memory)
  usage = 2,     // the request itself is wrong (unknown option, size of 0)
  badInput = 3,  // a scene, image or configuration is unusable
  noContext = 4  // no usable GL context, or a GL feature or limit is missing
};

// The only exception that the project throws on purpose. what() is a single line: file, what, where.
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  ErrorKind kind() const { return kind_; }

 private:
  ErrorKind kind_;
};

}  // namespace halfsilver
