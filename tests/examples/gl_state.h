// The state of the current OpenGL 4.5 context, read back, to see that somebody has left it as it was.
#pragma once

#include <string>
#include <vector>

struct GlValue {
  std::string name;  // as GL has it, with the index if there are several
  std::vector<double> value;
  bool operator==(const GlValue&) const = default;
};

// What a renderer may touch: bindings, raster and fragment state, pixel storage. Leaves all of it as it is.
std::vector<GlValue> glState();

// Names of what differs; both of glState().
std::vector<std::string> differences(const std::vector<GlValue>& before, const std::vector<GlValue>& after);
