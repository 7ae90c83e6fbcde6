#pragma once

#include <string>
#include <vector>

#include <halfsilver/settings.h>
#include "apps/view_request.h"

// What `tune` tries.
namespace halfsilver {

struct Candidate {
  std::string preset;              // from which the structure's settings start
  std::vector<std::string> tuned;  // names of the settings that the search varies
  Settings settings;               // complete, ready for use

  // What distinguishes it from the others: "kastrati2017 search.steps=3 voxels.resolution=64".
  std::string text() const;
};

// Candidates that differ in one growing setting: each needs more memory than the previous one.
using Ladder = std::vector<Candidate>;

// Every method of the table over its knobs. What is drawn comes from the request's preset or file, the structure (what
// methods read, and trace.method) from the method's own preset. Settings given by --set are not varied, and
// equal candidates are listed once. Throws Error: usage if nothing is left to try, otherwise as set() does.
std::vector<Ladder> tuneLadders(const ViewRequest& request);

// "identity (voxels.per_triangle), attributes (search.steps, ...)": what tuning varies of each method.
std::string tunedSettings();

}  // namespace halfsilver
