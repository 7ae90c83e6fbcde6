#include <halfsilver/methods.h>

namespace halfsilver {

// The methods' names for settings files; the real table brings all tracers, which need GL.
std::span<const MethodInfo> methods() {
  static const std::vector<MethodInfo> names = {{"none", ""},         {"attributes", ""}, {"depth-cube", ""},
                                                {"identity", ""},     {"bvh", ""},        {"screen-space", ""},
                                                {"screen-first", ""}, {"planar", ""},     {"cubemap", ""},
                                                {"voxels", ""},       {"exact", ""},      {"auto", ""}};
  return names;
}

}  // namespace halfsilver
