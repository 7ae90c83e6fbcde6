#include "bench/tasks.h"

#include <chrono>
#include <utility>

#include "apps/progress.h"
#include "bench/estimate.h"

namespace halfsilver::bench {

using Json = nlohmann::ordered_json;

std::vector<Json> measureAll(Points& points, std::span<const Task> tasks) {
  Estimate estimate;
  for (const Task& task : tasks)
    if (!points.find(task.key)) estimate.plan(task.work);
  Progress progress;
  std::vector<Json> results;
  for (const Task& task : tasks) {
    if (!points.find(task.key)) {
      const std::string left = estimate.left();
      progress.show("point " + std::to_string(results.size() + 1) + " of " + std::to_string(tasks.size()) + ": " +
                    task.label + (left.empty() ? "" : ", " + left));
      const auto start = std::chrono::steady_clock::now();
      Json point = task.key;
      task.measure(point);
      points.keep(std::move(point));
      estimate.done(task.work, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    results.push_back(*points.find(task.key));
  }
  return results;
}

}  // namespace halfsilver::bench
