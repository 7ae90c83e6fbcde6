#include "frame/frame_constants.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/integer.hpp>

#include <halfsilver/error.h>

namespace halfsilver {
namespace {

using glm::dmat4;
using glm::dvec3;
using glm::dvec4;

constexpr double kNearest = 1e-4;       // of the diagonal: the near plane inside the bounds
constexpr double kBeforeBounds = 0.99;  // of the distance to the bounds: the near plane outside them
constexpr double kSmallestDiagonal = 1e-30;
// What is drawn begins this much nearer than the depth of targets: reversed floats lose nothing by it. A power of two,
// so that depths keep their bits.
constexpr double kDrawnNear = 0x1p-20;

struct Basis {
  dvec3 forward, right, up;
};

Basis basisOf(const Camera& camera) {
  const dvec3 towards = dvec3(camera.target) - dvec3(camera.eye);
  const double length = glm::length(towards);
  if (!(length > 0) || !std::isfinite(length)) throw Error(ErrorKind::usage, "the camera's target is its eye");
  Basis basis{};
  basis.forward = towards / length;
  dvec3 across = glm::cross(basis.forward, dvec3(camera.up));
  const double parallel = 1e-6;
  if (!(glm::length(across) > parallel * glm::length(dvec3(camera.up))))
    across = glm::cross(basis.forward, std::abs(basis.forward.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(0, 0, -1));
  basis.right = glm::normalize(across);
  basis.up = glm::cross(basis.right, basis.forward);
  return basis;
}

// How a camera maps the scene to a picture.
struct Lens {
  Basis basis;
  double tangentX, tangentY;       // of half the angles of view
  double nearPlane, farPlane;      // 0: infinite
  double depthScale, depthOffset;  // reversed depth, 1 near to 0 far, is scale + offset / distance along the axis
  bool parallel;  // the tangents are half the picture in meters, and depth is scale * distance + offset
};

double chooseNear(const Camera& camera, const Bounds& bounds, double tangentX, double tangentY) {
  if (camera.nearPlane > 0) return camera.nearPlane;
  if (bounds.empty()) return kNearest;
  const dvec3 eye(camera.eye);
  const double outside = glm::length(glm::max(glm::max(dvec3(bounds.low) - eye, eye - dvec3(bounds.high)), dvec3(0)));
  // A point in a corner of the picture is nearer along the axis than along its ray.
  const double cornerCosine = 1 / std::sqrt(1 + tangentX * tangentX + tangentY * tangentY);
  const double diagonal = std::max(static_cast<double>(bounds.diagonal()), kSmallestDiagonal);
  return std::max(kNearest * diagonal, kBeforeBounds * cornerCosine * outside);
}

// Distance along the axis to behind all of the bounds.
double farthest(const Camera& camera, const Basis& basis, const Bounds& bounds) {
  double far = 0;
  for (unsigned i = 0; i < 8 && !bounds.empty(); ++i) {
    const dvec3 corner(i & 1 ? bounds.high.x : bounds.low.x, i & 2 ? bounds.high.y : bounds.low.y,
                       i & 4 ? bounds.high.z : bounds.low.z);
    far = std::max(far, glm::dot(corner - dvec3(camera.eye), basis.forward));
  }
  return std::max(1.001 * far, 2.0 * static_cast<double>(camera.nearPlane) + kSmallestDiagonal);
}

Lens lensOf(const Camera& camera, const Bounds& bounds, int width, int height) {
  if (width < 1 || height < 1) throw Error(ErrorKind::usage, "the picture's size must be at least 1 x 1");
  const bool parallel = camera.parallelHeight > 0;
  if (!parallel && !(camera.verticalFov > 0 && camera.verticalFov < 3.14159f))
    throw Error(ErrorKind::usage, "the camera's field of view must lie between 0 and 180 degrees");
  Lens lens{};
  lens.basis = basisOf(camera);
  const double aspect = static_cast<double>(width) / height;
  if (parallel) {
    lens.parallel = true;
    lens.tangentY = 0.5 * static_cast<double>(camera.parallelHeight);
    lens.tangentX = lens.tangentY * aspect;
    lens.nearPlane = camera.nearPlane;
    lens.farPlane = camera.farPlane > camera.nearPlane ? camera.farPlane : farthest(camera, lens.basis, bounds);
    lens.depthScale = -1 / (lens.farPlane - lens.nearPlane);
    lens.depthOffset = -lens.depthScale * lens.farPlane;
    return lens;
  }
  lens.tangentY = std::tan(0.5 * static_cast<double>(camera.verticalFov));
  lens.tangentX = lens.tangentY * aspect;
  const double nearPlane = chooseNear(camera, bounds, lens.tangentX, lens.tangentY);
  const double farPlane = camera.farPlane > nearPlane ? camera.farPlane : 0;
  lens.nearPlane = nearPlane;
  lens.farPlane = farPlane;
  lens.depthScale = farPlane > 0 ? -nearPlane / (farPlane - nearPlane) : 0.0;
  lens.depthOffset = farPlane > 0 ? farPlane * nearPlane / (farPlane - nearPlane) : nearPlane;
  return lens;
}

// A coordinate of a sample, from its bits in reverse order. The factors are even, so only higher bits of the coordinate
// decide whether one is flipped: strata stay strata (Owen 1995). The half bit brings the first sample to the center.
float scrambled(std::uint32_t bits, const std::array<std::uint32_t, 2>& factors) {
  for (const std::uint32_t factor : factors) bits ^= bits * factor;
  return static_cast<float>((glm::bitfieldReverse(bits) ^ 0x80000000u) * 0x1p-32 - 0.5);
}

// No shader reads them: who keeps what the rays of equal constants need must see that there are others.
std::uint32_t rayRules(const PrimarySettings& primary, const ShadowSettings& shadow) {
  const std::uint32_t fields[][2] = {
      // bits, value
      {4, static_cast<std::uint32_t>(primary.every)},         {3, static_cast<std::uint32_t>(primary.neighborhood)},
      {2, static_cast<std::uint32_t>(primary.multisampling)}, {1, static_cast<std::uint32_t>(primary.hits)},
      {2, static_cast<std::uint32_t>(shadow.method)},         {5, static_cast<std::uint32_t>(shadow.kernel)},
      {14, static_cast<std::uint32_t>(shadow.resolution)},    {1, static_cast<std::uint32_t>(shadow.projection)}};
  std::uint32_t rules = 0;
  for (const auto& [bits, value] : fields) rules = rules << bits | value;
  return rules;
}

}  // namespace

shared::FrameConstants makeFrameConstants(const Camera& camera, const Bounds& bounds, const Sky& sky,
                                          const Settings& settings, int width, int height, const LightRanges& lights,
                                          const glm::vec2& jitter) {
  const Lens lens = lensOf(camera, bounds, width, height);
  const Basis& basis = lens.basis;
  const double diagonal = bounds.empty() ? 0.0 : bounds.diagonal();

  // Rows of clip = M * (p - eye, 1): w is the distance along the axis, z / w the reversed depth.
  const dvec3 eye(camera.eye);
  const auto row = [&](const dvec3& axis, double offset) { return dvec4(axis, offset - glm::dot(axis, eye)); };
  // Samples come to lie at the centers of pixels.
  const glm::dvec2 shift = 2.0 * glm::dvec2(jitter) / glm::dvec2(width, height);
  const dvec3 depthAxis = lens.parallel ? dvec3(0) : basis.forward;
  const dmat4 viewProjection = glm::transpose(
      dmat4(row(basis.right / lens.tangentX - shift.x * depthAxis, lens.parallel ? -shift.x : 0),
            row(basis.up / lens.tangentY - shift.y * depthAxis, lens.parallel ? -shift.y : 0),
            row(basis.forward * lens.depthScale, lens.depthOffset), row(depthAxis, lens.parallel ? 1 : 0)));

  shared::FrameConstants frame{};
  frame.viewProjection = glm::mat4(viewProjection);
  frame.eye = camera.eye;
  frame.pixelCone = static_cast<float>(2 * lens.tangentY / height);
  frame.forward = basis.forward;
  frame.nearPlane = static_cast<float>(lens.nearPlane);
  frame.right = basis.right * lens.tangentX;
  frame.farPlane = static_cast<float>(lens.farPlane);
  frame.up = basis.up * lens.tangentY;
  frame.minDistance = smallestHitDistance(bounds);
  frame.boundsLow = bounds.empty() ? glm::vec3(0) : bounds.low;
  frame.diagonal = static_cast<float>(diagonal);
  frame.boundsHigh = bounds.empty() ? glm::vec3(0) : bounds.high;
  frame.skyIsImage = sky.image.empty() ? 0 : 1;
  frame.skyZenith = sky.zenith * sky.intensity;
  frame.skyIntensity = sky.intensity;
  frame.skyHorizon = sky.horizon * sky.intensity;
  frame.skyGround = sky.ground * sky.intensity;
  frame.width = static_cast<std::uint32_t>(width);
  frame.height = static_cast<std::uint32_t>(height);
  frame.directLights = lights.direct;
  frame.mappedLights = lights.mapped;
  frame.skyDirections = lights.skyDirections;
  frame.hemispheres = lights.hemispheres;
  frame.cullBackFaces = settings.scene.cullBackFaces ? 1 : 0;
  frame.maxRoughness = settings.select.maxRoughness;
  frame.minReflectivity = settings.select.minReflectivity;
  frame.selectFraction = settings.select.fraction;
  frame.exposure = std::exp2(settings.image.exposure);
  frame.selectMode = static_cast<std::uint32_t>(settings.select.mode);
  frame.toneMap = settings.image.toneMap == ToneMap::filmic ? 0 : 1;
  frame.selectPattern = static_cast<std::uint32_t>(settings.select.pattern);
  frame.minContribution = settings.select.minContribution;
  static_assert(FILL_SKY == static_cast<int>(Fill::sky) && FILL_NEIGHBORS == static_cast<int>(Fill::neighbours));
  const bool traces = settings.select.mode != SelectMode::none && settings.trace.method != "none";
  frame.fill = traces ? static_cast<std::uint32_t>(settings.select.fill) : FILL_SKY;
  frame.traces = static_cast<std::uint32_t>(settings.trace.bounces);
  frame.effect = static_cast<std::uint32_t>(settings.trace.effect);
  frame.effectSamples = static_cast<std::uint32_t>(settings.effect.samples);
  const bool glossy = settings.effect.glossy && settings.trace.effect == Effect::reflection && traces;
  frame.glossySamples = glossy ? static_cast<std::uint32_t>(settings.effect.samples) : 0;
  frame.roulette = settings.effect.roulette ? 1 : 0;
  frame.layerOpacity = settings.effect.transfer == Transfer::blend ? 1 : settings.effect.opacity;
  frame.transfer = static_cast<std::uint32_t>(settings.effect.transfer);
  frame.bounces = static_cast<std::uint32_t>(settings.trace.bounces);
  frame.occlusionRadius = settings.effect.radius > 0 ? settings.effect.radius : FAR_AWAY;
  frame.shadowSamples = static_cast<std::uint32_t>(settings.shadow.samples);
  frame.jitter = jitter;
  frame.drawnNear =
      static_cast<float>(camera.nearPlane > 0 || lens.parallel ? lens.nearPlane : kDrawnNear * lens.nearPlane);
  frame.parallel = lens.parallel ? 1 : 0;
  frame.rayRules = rayRules(settings.primary, settings.shadow);
  return frame;
}

CameraMatrices cameraMatrices(const Camera& camera, const Bounds& bounds, const Target& target) {
  const Lens lens = lensOf(camera, bounds, target.width, target.height);
  const Basis& basis = lens.basis;
  const dvec3 eye(camera.eye);
  const auto row = [&eye](const dvec3& axis) { return dvec4(axis, -glm::dot(axis, eye)); };
  const dmat4 view = glm::transpose(dmat4(row(basis.right), row(basis.up), row(-basis.forward), dvec4(0, 0, 0, 1)));
  // The distance along the axis is -z. Depth d of a clip space 0..1, reversed, is 1 - 2 d in one of -1..1, standard.
  const bool reversed = target.depth == DepthUse::reversed;
  const double zScale = reversed ? -lens.depthScale : 2 * lens.depthScale - 1;
  const double zOffset = reversed ? lens.depthOffset : -2 * lens.depthOffset;
  const dvec4 depth = lens.parallel ? dvec4(0, 0, reversed ? -lens.depthScale : 2 * lens.depthScale,
                                            reversed ? lens.depthOffset : 1 - 2 * lens.depthOffset)
                                    : dvec4(0, 0, zScale, zOffset);
  const dmat4 projection = glm::transpose(dmat4(dvec4(1 / lens.tangentX, 0, 0, 0), dvec4(0, 1 / lens.tangentY, 0, 0),
                                                depth, lens.parallel ? dvec4(0, 0, 0, 1) : dvec4(0, 0, -1, 0)));
  return {glm::mat4(view), glm::mat4(projection)};
}

glm::vec2 sampleOffset(std::uint32_t sample) {
  // Bits of the number choose columns of the two generator matrices, here in reverse order.
  std::uint32_t y = 0, column = 1;
  for (std::uint32_t rest = sample; rest != 0; rest >>= 1, column ^= column << 1)
    if (rest & 1) y ^= column;
  return {scrambled(sample, {0x0a807a90, 0x58d51a04}), scrambled(y, {0x5be2e842, 0x58846908})};
}

glm::dvec2 meanMotion(const Camera& before, const Camera& now, const glm::ivec2& size) {
  const Lens from = lensOf(before, {}, size.x, size.y), to = lensOf(now, {}, size.x, size.y);
  const double distance = glm::length(dvec3(before.target) - dvec3(before.eye));
  const double place = 1 / std::sqrt(3.0);  // whose mean is that of the picture (Gauss)
  glm::dvec2 sum(0);
  for (const glm::dvec2& seen : {glm::dvec2(-place, -place), {place, -place}, {-place, place}, {place, place}}) {
    const dvec3 across = seen.x * from.tangentX * from.basis.right + seen.y * from.tangentY * from.basis.up;
    const dvec3 point = dvec3(before.eye) + distance * from.basis.forward + (from.parallel ? 1.0 : distance) * across;
    const dvec3 fromEye = point - dvec3(now.eye);
    const double along = to.parallel ? 1.0 : glm::dot(fromEye, to.basis.forward);
    if (along <= 0) return glm::dvec2(0);
    sum += glm::dvec2(glm::dot(fromEye, to.basis.right) / to.tangentX, glm::dot(fromEye, to.basis.up) / to.tangentY) /
               along -
           seen;
  }
  const glm::dvec2 motion = 0.25 * sum * 0.5 * glm::dvec2(size);
  return std::isfinite(motion.x) && std::isfinite(motion.y) ? motion : glm::dvec2(0);
}

float smallestHitDistance(const Bounds& bounds) {
  if (bounds.empty()) return 0;
  const glm::vec3 largest = glm::max(glm::abs(bounds.low), glm::abs(bounds.high));
  return NEAREST_SHARE * std::max({largest.x, largest.y, largest.z});
}

}  // namespace halfsilver
