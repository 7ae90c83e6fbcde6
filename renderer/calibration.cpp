#include <halfsilver/calibration.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <limits>

#include <halfsilver/error.h>
#include <halfsilver/methods.h>

namespace halfsilver {
namespace {

constexpr int kWarmFrames = 3;
// A method whose frame takes this much longer than the best so far is not measured further.
constexpr double kHopeless = 4;

class Measurement {
 public:
  Measurement(Renderer& renderer, const CalibrationInputs& inputs) : renderer_(&renderer), inputs_(&inputs) {
    once_ = inputs.settings;
    once_.effect.passes = 1;
    once_.effect.progressive = false;
    once_.image.motion = false;
  }

  // The least time of a frame over a method; `best`: of the others.
  double of(const std::string& method, double best) {
    once_.trace.method = method;
    draw();  // builds structures and compiles shaders
    double least = std::numeric_limits<double>::max();
    // Each takes the same steps.
    for (int frame = 0; frame < kWarmFrames && (frame == 0 || least < kHopeless * best); ++frame) {
      if (inputs_->advance) inputs_->advance(frame);
      least = std::min(least, draw());
    }
    return least;
  }

 private:
  double draw() {
    const auto start = std::chrono::steady_clock::now();
    renderer_->render(inputs_->camera, once_, inputs_->target);
    static_cast<void>(renderer_->report());  // waits for the frame
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  }

  Renderer* renderer_;
  const CalibrationInputs* inputs_;
  Settings once_;
};

std::string timesText(const std::vector<MethodTime>& measured) {
  std::string text;
  for (const MethodTime& time : measured) {
    char number[32];
    std::snprintf(number, sizeof(number), " %.3g ms", time.milliseconds);
    text += (text.empty() ? "" : ", ") + time.method + number;
  }
  return text;
}

}  // namespace

MethodChoice chooseMethod(Renderer& renderer, const CalibrationInputs& inputs) {
  if (renderer.device().software && renderer.traces("exact"))
    return {"exact", "the device draws in software, rays on the CPU take a fraction of the time", {}};
  Measurement measurement(renderer, inputs);
  MethodChoice choice;
  double best = std::numeric_limits<double>::max(), bestWeighed = best;
  std::string refused;
  for (const MethodInfo& method : methods()) {
    if (!method.exact || !renderer.traces(method.name)) continue;
    double time = 0;
    try {
      time = measurement.of(method.name, best);
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::failed) throw;
      refused += "; " + method.name + ": " + error.what();  // its structure is too large for the device
      continue;
    }
    const FrameReport& report = renderer.report();
    if (report.overflow + report.lostFragments > 0) {
      refused += "; " + method.name + " gives up rays";
      continue;
    }
    choice.measured.push_back({method.name, time});
    best = std::min(best, time);
    const double weighed = method.name == inputs.present ? time / kMethodHysteresis : time;
    if (weighed >= bestWeighed) continue;
    bestWeighed = weighed;
    choice.method = method.name;
  }
  if (choice.measured.empty()) throw Error(ErrorKind::failed, "trace.method=auto: no method can draw this" + refused);
  choice.reason = "measured: " + timesText(choice.measured) + " per frame" + refused;
  renderer.forgetHistory();
  return choice;
}

}  // namespace halfsilver
