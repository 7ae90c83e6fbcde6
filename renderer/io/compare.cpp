#include <halfsilver/io.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <halfsilver/error.h>
#include <halfsilver/ray_kinds.h>

namespace halfsilver {
namespace {

[[noreturn]] void reject(const std::string& what) { throw Error(ErrorKind::badInput, what); }

std::string sizeText(const Image& image) { return std::to_string(image.width) + "x" + std::to_string(image.height); }

// Only R, G and B; gray is copied to all three.
Image colors(const Image& image, const char* which) {
  const int gray = image.channel("Y");
  const char* names[] = {"R", "G", "B"};
  Image result{image.width, image.height, {"R", "G", "B"}, {}};
  result.data.resize(image.pixelCount() * 3);
  std::size_t bad = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const int source = image.channel(names[c]) >= 0 ? image.channel(names[c]) : gray;
    if (source < 0) reject(std::string("the ") + which + " has no channel " + names[c]);
    for (std::size_t p = 0; p < image.pixelCount(); ++p) {
      const float value = image.data[p * image.channels.size() + static_cast<std::size_t>(source)];
      bad += !std::isfinite(value);
      result.data[p * 3 + c] = value;
    }
  }
  if (bad > 0)
    reject("the " + std::string(which) + " contains " + std::to_string(bad) + " color values that are not finite");
  return result;
}

// One channel of an image, by pixel; 0 everywhere if there is none of that name.
class Plane {
 public:
  Plane(const Image& image, const std::string& name)
      : data_(image.data), stride_(image.channels.size()), channel_(image.channel(name)) {}
  float operator[](std::size_t pixel) const {
    return channel_ < 0 ? 0.0f : data_[pixel * stride_ + static_cast<std::size_t>(channel_)];
  }

 private:
  const std::vector<float>& data_;
  std::size_t stride_;
  int channel_;
};

bool hasLayers(const Image& image) {
  return image.channel("selected.Y") >= 0 && image.channel("hit.T") >= 0 && image.channel("hit.id") >= 0;
}

// The difference of two counts that files hold as floats.
// Counts are whole numbers that a float can hold, whatever a file says.
void checkCount(float value) {
  if (!(value >= 0 && value <= 16777216)) reject("a layer of counts holds " + std::to_string(value));
}

std::uint64_t beyond(float a, float b) { return a > b ? static_cast<std::uint64_t>(a - b) : 0; }

KindComparison compareKind(const Image& image, const Image& reference, const std::string& kind, double diagonal) {
  const auto plane = [&kind](const Image& of, const char* what) { return Plane(of, what + ("." + kind)); };
  const Plane rays = plane(image, "rays"), referenceRays = plane(reference, "rays");
  const Plane hits = plane(image, "hits"), referenceHits = plane(reference, "hits");
  const Plane distance = plane(image, "distance"), referenceDistance = plane(reference, "distance");
  KindComparison result{.kind = kind};
  for (std::size_t p = 0; p < image.pixelCount(); ++p) {
    for (const Plane* counts : {&rays, &referenceRays, &hits, &referenceHits}) checkCount((*counts)[p]);
    result.rays += static_cast<std::uint64_t>(referenceRays[p]);
    result.unmatched += beyond(rays[p], referenceRays[p]) + beyond(referenceRays[p], rays[p]);
    if (rays[p] != referenceRays[p]) continue;
    result.falseOcclusion += beyond(hits[p], referenceHits[p]);
    result.falseVisibility += beyond(referenceHits[p], hits[p]);
    result.wrongDistance +=
        hits[p] == referenceHits[p] && hits[p] * std::abs(double(distance[p]) - referenceDistance[p]) > 1e-3 * diagonal;
  }
  return result;
}

bool countsKind(const Image& image, const std::string& kind) { return image.channel("rays." + kind) >= 0; }

bool countsAny(const Image& image) {
  return std::any_of(kRayKindNames.begin(), kRayKindNames.end(),
                     [&](const char* kind) { return countsKind(image, kind); });
}

// Of all kinds that one of the files counts, if both count any.
std::vector<KindComparison> compareKinds(const Image& image, const Image& reference, double diagonal) {
  std::vector<KindComparison> kinds;
  if (!countsAny(image) || !countsAny(reference)) return kinds;
  for (const std::string kind : kRayKindNames)
    if (countsKind(image, kind) || countsKind(reference, kind))
      kinds.push_back(compareKind(image, reference, kind, diagonal));
  return kinds;
}

double sceneDiagonal(const ImageFile& image, const ImageFile& reference, std::optional<double> given) {
  if (given) return *given;
  if (!image.diagonal && !reference.diagonal)
    throw Error(ErrorKind::usage,
                "neither file contains the scene's diagonal (attribute halfsilver:diagonal): give it with --diagonal");
  const double a = image.diagonal.value_or(*reference.diagonal);
  const double b = reference.diagonal.value_or(a);
  if (!(std::abs(a - b) <= 1e-3 * std::max(a, b)))
    reject("the files are of different scenes: their diagonals are " + std::to_string(a) + " and " + std::to_string(b) +
           " m");
  return b;
}

void requireSameSize(const Image& image, const Image& reference) {
  if (image.width != reference.width || image.height != reference.height)
    reject("the image is " + sizeText(image) + ", the reference " + sizeText(reference));
}

}  // namespace

LayerComparison compareLayers(const Image& image, const Image& reference, double diagonal) {
  requireSameSize(image, reference);
  if (!hasLayers(image) || !hasLayers(reference)) reject("layers need the channels selected.Y, hit.T and hit.id");
  const Plane selected(image, "selected.Y"), referenceSelected(reference, "selected.Y");
  const Plane t(image, "hit.T"), referenceT(reference, "hit.T");
  const Plane id(image, "hit.id"), referenceId(reference, "hit.id");
  LayerComparison result;
  std::uint64_t error = 0, miss = 0, falseHit = 0, wrongId = 0, mismatch = 0, overflow = 0;
  for (std::size_t p = 0; p < image.pixelCount(); ++p) {
    const bool a = selected[p] > 0.5f, b = referenceSelected[p] > 0.5f;
    if (!a && !b) continue;
    ++result.pixels;
    const bool hit = t[p] >= 0, referenceHit = referenceT[p] >= 0;
    const bool far = hit && referenceHit && std::abs(double(t[p]) - referenceT[p]) > 1e-3 * diagonal;
    error += hit != referenceHit || far;
    miss += referenceHit && !hit;
    falseHit += hit && !referenceHit;
    wrongId += hit && referenceHit && id[p] != referenceId[p];
    mismatch += a != b;
    overflow += t[p] == -3.0f;
  }
  const auto share = [&](std::uint64_t count) {
    return result.pixels ? static_cast<double>(count) / static_cast<double>(result.pixels) : 0.0;
  };
  result.hitError = share(error);
  result.falseMiss = share(miss);
  result.falseHit = share(falseHit);
  result.wrongId = share(wrongId);
  result.selectedMismatch = share(mismatch);
  result.overflow = share(overflow);
  result.kinds = compareKinds(image, reference, diagonal);
  return result;
}

Comparison compareImages(const ImageFile& image, const ImageFile& reference, std::optional<double> diagonal) {
  requireSameSize(image.image, reference.image);
  if (image.linear != reference.linear)
    reject("one file contains linear radiance, the other display values, which cannot be compared");
  const Image a = colors(image.image, "image"), b = colors(reference.image, "reference");
  Comparison result;
  double sum = 0, peak = 1;
  for (std::size_t i = 0; i < a.data.size(); ++i) {
    const double difference = std::abs(double(a.data[i]) - double(b.data[i]));
    sum += difference * difference;
    result.maxError = std::max(result.maxError, difference);
    peak = std::max({peak, double(a.data[i]), double(b.data[i])});
  }
  result.rmse = std::sqrt(sum / static_cast<double>(a.data.size()));
  result.psnrDb = result.rmse > 0 ? 20 * std::log10(peak / result.rmse) : std::numeric_limits<double>::infinity();
  result.perceptual = comparePerceptually(a, b);
  if (hasLayers(image.image) && hasLayers(reference.image))
    result.layers = compareLayers(image.image, reference.image, sceneDiagonal(image, reference, diagonal));
  return result;
}

}  // namespace halfsilver
