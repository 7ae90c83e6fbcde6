#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <halfsilver/tracer.h>
#include "gpu/tracing_scenes.h"

namespace halfsilver::testing {

// What a method's answers to rays of one kind are worth, by another's.
struct Witness {
  std::uint64_t rays = 0;
  std::uint64_t hits = 0;             // of the truth
  std::uint64_t falseOcclusion = 0;   // a hit where the truth has none
  std::uint64_t falseVisibility = 0;  // no hit where it has one
  std::uint64_t wrongDistance = 0;    // both hit, farther apart than 0.1 % of the diagonal

  // Of differences where a hit lies nearer than 1e-5 of the diagonal: a ray that starts on its triangle's edge meets
  // the one beside it or not, by rounding.
  std::uint64_t atEdges = 0;

  std::uint64_t wrong() const { return falseOcclusion + falseVisibility + wrongDistance; }
};
using Witnesses = std::array<Witness, RAY_KINDS>;

// A tracer that has every queue of stored rays traced by a method and by exact rays, counts where they differ, and
// answers as the method does. `counts` outlives it.
Method witnessedMethod(const std::string& method, const Method& exact, Witnesses& counts);

// Frames over "witnessed", the default method with exact rays beside it.
class WitnessTest : public TracingTest {
 protected:
  std::vector<Method> methods(const Scene& scene) const override;

  std::unique_ptr<Witnesses> counts_ = std::make_unique<Witnesses>();  // the renderer keeps their place
};

}  // namespace halfsilver::testing
