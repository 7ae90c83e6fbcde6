#pragma once

#include <string>
#include <vector>

#include <halfsilver/gl/api.h>

namespace halfsilver::gl {

struct DebugMessage {
  GLenum type = 0;      // GL_DEBUG_TYPE_ERROR, ...
  GLenum severity = 0;  // GL_DEBUG_SEVERITY_HIGH, ...
  std::string text;

  // Wrong use of GL, as opposed to advice.
  bool error() const {
    return type == GL_DEBUG_TYPE_ERROR || type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR ||
           severity == GL_DEBUG_SEVERITY_HIGH;
  }
};

// Collects the driver's messages of high and medium severity and all errors while it lives; replaces a callback that
// the context had. Use with the context that is current at construction, on one thread.
class DebugLog {
 public:
  explicit DebugLog(const Api& api);
  ~DebugLog();
  DebugLog(const DebugLog&) = delete;
  DebugLog& operator=(const DebugLog&) = delete;

  // The messages since the last call. Messages of commands that the GPU has yet to run are not waited for.
  std::vector<DebugMessage> take();

 private:
  const Api* api_;
  bool wasEnabled_, wasSynchronous_;
  std::vector<DebugMessage> messages_;
};

}  // namespace halfsilver::gl
