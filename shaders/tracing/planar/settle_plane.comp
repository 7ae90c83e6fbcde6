// The plane with the most votes; of equals, the first. One invocation.
#include "shared/bindings.h"
#include "shared/passes/captures.h"

layout(local_size_x = 1) in;
layout(std430, binding = SSBO_PLANES) buffer PlaneBlock { MirrorPlanes planes; };

void main() {
  uint most = 0u;
  planes.chosen = vec4(0.0);
  for (int i = 0; i < PLANE_CANDIDATES; ++i) {
    if (planes.votes[i] <= most) continue;
    most = planes.votes[i];
    planes.chosen = planes.candidates[i];
  }
}
