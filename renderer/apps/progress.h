#pragma once

#include <string>

namespace halfsilver {

// One line of progress on stderr; silent unless stderr is a terminal. Cleared on destruction.
class Progress {
 public:
  Progress();
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(const std::string& text);
  void clear();

 private:
  bool terminal_ = false;
  bool shown_ = false;
};

}  // namespace halfsilver
