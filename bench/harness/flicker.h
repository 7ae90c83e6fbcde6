#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <halfsilver/image.h>

namespace halfsilver::bench {

// How much the picture flickers during a slow motion, beyond the changes of the scene itself.
struct Flicker {
  std::uint64_t pixels = 0;     // that count
  double mean = 0;              // excess change per pixel and step, in display values 0..1
  double percentile99 = 0;      // of the same
  double hits = 0;              // changes between hit and miss that the reference does not make, per pixel and step
  std::uint64_t identical = 0;  // steps in which no pixel of the picture changed more than in the reference
  std::uint64_t steps = 0;
};

// Takes pairs of frames, the method's and the reference's. Excess change of a pixel from one frame to the next:
// |change in the method| - |change in the reference|, at least 0, taken for the color channel in which it is largest.
class FlickerMeter {
 public:
  enum class Pixels {
    traced,  // those that are in any frame
    all
  };
  explicit FlickerMeter(Pixels counted = Pixels::traced) : counted_(counted) {}

  // Layers of the same size with R, G, B, selected.Y and hit.T; the picture's values are clipped to 0..1.
  void add(const Image& frame, const Image& reference);
  Flicker result() const;

 private:
  struct Pair {
    Image frame, reference;
  };
  Pixels counted_;
  std::optional<Pair> last_;
  std::vector<char> counts_;    // per pixel
  std::vector<float> excess_;   // all pixels of each step
  std::uint64_t hitFlips_ = 0;  // see Flicker::hits
  std::uint64_t steps_ = 0, quiet_ = 0;
};

}  // namespace halfsilver::bench
