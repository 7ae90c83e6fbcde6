#pragma once

#include <memory>

#include <halfsilver/gl/api.h>

namespace halfsilver::gl {

struct SavedState;

// Saves the state of the caller's context and sets GL's initial values, which the renderer's passes start from;
// restores everything at the end of its life. Viewports and scissor boxes keep the caller's values.
//
// Out of reach, so the caller must not have it active: transform feedback, conditional rendering, occlusion queries.
class StateGuard {
 public:
  explicit StateGuard(const Api& api);
  ~StateGuard();
  StateGuard(const StateGuard&) = delete;
  StateGuard& operator=(const StateGuard&) = delete;

 private:
  const Api* api_;
  std::unique_ptr<const SavedState> saved_;
};

}  // namespace halfsilver::gl
