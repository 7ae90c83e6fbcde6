#include "bench/harness/tasks.h"

#include <chrono>
#include <set>
#include <utility>

#include "apps/progress.h"
#include "bench/harness/estimate.h"

namespace halfsilver::bench {
namespace {

using Json = nlohmann::ordered_json;

// "mode 2 of 5, coverage, point 3 of 30: sphere, about 2 min left"
std::string progressText(std::span<const Batch> batches, const Batch& batch, const AnyTask& task,
                         const Estimate& estimate) {
  std::string text;
  if (batches.size() > 1) {
    text += "mode " + std::to_string(&batch - batches.data() + 1);
    text += " of " + std::to_string(batches.size());
    text += ", " + batch.mode;
    text += ", ";
  }
  text += "point " + std::to_string(&task - batch.tasks.data() + 1);
  text += " of " + std::to_string(batch.tasks.size());
  text += ": " + task.label;
  if (const std::string left = estimate.left(); !left.empty()) text += ", " + left;
  return text;
}

}  // namespace

double workOf(double frames, std::size_t triangles) { return frames * (20000 + static_cast<double>(triangles)); }

std::vector<MeasuredPoints> measureAll(std::span<Batch> batches) {
  Estimate estimate;
  for (const Batch& batch : batches)
    for (const AnyTask& task : batch.tasks)
      if (!batch.points.find(task.key)) estimate.plan(task.work);
  Progress progress;
  std::vector<MeasuredPoints> results;
  for (Batch& batch : batches) {
    MeasuredPoints& measured = results.emplace_back();
    std::set<std::string> ended;
    for (const AnyTask& task : batch.tasks) {
      const bool kept = batch.points.find(task.key);
      if (ended.contains(task.series)) {
        if (!kept) estimate.plan(-task.work);
        continue;
      }
      if (!kept) {
        progress.show(progressText(batches, batch, task, estimate));
        const auto start = std::chrono::steady_clock::now();
        Json point = task.key;
        point.update(task.measure());
        batch.points.keep(std::move(point));
        estimate.done(task.work, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
      }
      measured.push_back(*batch.points.find(task.key));
      if (task.ends && task.ends(measured.back())) ended.insert(task.series);
    }
  }
  return results;
}

}  // namespace halfsilver::bench
