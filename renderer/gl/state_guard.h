#pragma once

#include <memory>

#include <halfsilver/gl/api.h>

namespace halfsilver::gl {

struct SavedState;

// Saves the state of the caller's context and sets GL's initial values, which the renderer's passes start from;
// restores everything at the end of its life. Viewports and scissor boxes keep the caller's values.
//
// If the caller keeps no state (Api::restoresState), it only sets the initial values and asks the driver for nothing:
// each answer makes a driver's threads wait for one another.
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
  std::unique_ptr<const SavedState> saved_;  // null: nothing is restored
};

}  // namespace halfsilver::gl
