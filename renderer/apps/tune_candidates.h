#pragma once

#include <string>
#include <vector>

#include <halfsilver/settings.h>
#include "apps/view_request.h"

// What `tune` tries.
namespace halfsilver {

struct Candidate {
  std::string preset;              // that the structure's settings start from
  std::vector<std::string> tuned;  // names of the settings that the search varies
  Settings settings;               // all of them, as they are to be used

  // "kastrati2017 search.steps=3 voxels.resolution=64": what tells it from the others.
  std::string text() const;
};

// Candidates that differ in one setting, which grows: each needs more memory than the one before.
using Ladder = std::vector<Candidate>;

// Every method of the table over its knobs. What is drawn comes from the request's preset or file, the structure (what
// methods read, and trace.method) from the method's own preset; what the request names by --set stays as it is, and
// equal candidates are one. Throws Error: usage if nothing is left to try, or as the settings themselves do.
std::vector<Ladder> tuneLadders(const ViewRequest& request);

// "identity (voxels.per_triangle), attributes (search.steps, ...)": what is varied of each method.
std::string tunedSettings();

}  // namespace halfsilver
