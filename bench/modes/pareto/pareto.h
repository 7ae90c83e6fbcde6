#pragma once

#include <halfsilver/image.h>
#include "bench/modes/mode.h"
#include "bench/modes/pareto/point.h"

namespace halfsilver::bench {

// Time against accuracy, each method with a range of settings: pareto.csv, .json, .svg and .png.
Mode paretoMode();

// The number of rounds for a variant whose frame takes so long: as many as fit into kParetoSeconds, at least two.
int roundsFor(double frameMilliseconds, bool quick);

// `diagonal` in meters. Throws Error (badInput) if the sizes differ or a channel is missing.
CommonRays compareCommonRays(Image image, Image reference, double diagonal);

}  // namespace halfsilver::bench
