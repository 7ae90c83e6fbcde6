#pragma once

#include <halfsilver/builtin.h>

namespace halfsilver::demo {

// The game's own level, made once.
inline const Model& level() {
  static const Model model = makeBuiltin("game");
  return model;
}

}  // namespace halfsilver::demo
