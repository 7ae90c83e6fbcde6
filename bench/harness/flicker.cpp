#include "bench/harness/flicker.h"

#include <algorithm>
#include <cmath>

namespace halfsilver::bench {
namespace {

// Far below what a display shows, far above what the order of additions changes.
constexpr float kFloatNoise = 1e-4f;

class Channel {
 public:
  Channel(const Image& image, const char* name)
      : image_(&image), channel_(static_cast<std::size_t>(image.channel(name))) {}
  float operator[](std::size_t pixel) const {
    return image_->data[pixel * static_cast<std::size_t>(image_->channelCount()) + channel_];
  }

 private:
  const Image* image_;
  std::size_t channel_;
};

std::vector<float> largestChanges(const Image& before, const Image& after) {
  std::vector<float> changes(after.pixelCount(), 0.0f);
  for (const char* name : {"R", "G", "B"}) {
    const Channel a(before, name), b(after, name);
    for (std::size_t p = 0; p < changes.size(); ++p)
      changes[p] = std::max(changes[p], std::abs(std::clamp(b[p], 0.0f, 1.0f) - std::clamp(a[p], 0.0f, 1.0f)));
  }
  return changes;
}

}  // namespace

void FlickerMeter::add(const Image& frame, const Image& reference) {
  const std::size_t pixels = frame.pixelCount();
  counts_.resize(pixels, counted_ == Pixels::all ? 1 : 0);
  const Channel selected(frame, "selected.Y");
  for (std::size_t p = 0; p < pixels; ++p) counts_[p] = counts_[p] || selected[p] > 0 ? 1 : 0;
  if (last_) {
    const std::vector<float> own = largestChanges(last_->frame, frame);
    const std::vector<float> scene = largestChanges(last_->reference, reference);
    const Channel a(last_->frame, "hit.T"), b(frame, "hit.T");
    const Channel c(last_->reference, "hit.T"), d(reference, "hit.T");
    bool quiet = true;
    for (std::size_t p = 0; p < pixels; ++p) {
      const float excess = std::max(0.0f, own[p] - scene[p]);
      excess_.push_back(excess > kFloatNoise ? excess : 0.0f);
      quiet = quiet && excess <= kFloatNoise;
      if ((a[p] >= 0) != (b[p] >= 0) && (c[p] >= 0) == (d[p] >= 0)) ++hitFlips_;
    }
    ++steps_;
    quiet_ += quiet ? 1 : 0;
  }
  last_ = Pair{frame, reference};
}

Flicker FlickerMeter::result() const {
  Flicker flicker;
  flicker.steps = steps_;
  flicker.identical = quiet_;
  flicker.pixels = static_cast<std::uint64_t>(std::count(counts_.begin(), counts_.end(), 1));
  if (flicker.pixels == 0 || steps_ == 0) return flicker;
  std::vector<float> values;
  for (std::size_t i = 0; i < excess_.size(); ++i)
    if (counts_[i % counts_.size()]) values.push_back(excess_[i]);
  double sum = 0;
  for (const float value : values) sum += static_cast<double>(value);
  flicker.mean = sum / static_cast<double>(values.size());
  const auto rank = values.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), rank, values.end());
  flicker.percentile99 = static_cast<double>(*rank);
  flicker.hits = static_cast<double>(hitFlips_) / static_cast<double>(flicker.pixels * steps_);
  return flicker;
}

}  // namespace halfsilver::bench
