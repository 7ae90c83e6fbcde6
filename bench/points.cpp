#include "bench/points.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

#include <halfsilver/error.h>
#include "apps/program.h"
#include "io/atomic_file.h"

namespace halfsilver::bench {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

}  // namespace

Points::Points(fs::path file, std::string mode) : file_(std::move(file)) {
  record_["mode"] = mode;
  record_["points"] = Json::array();
  const AtomicFile writable(file_);
  std::error_code error;
  if (!fs::exists(file_, error)) return;
  std::ifstream stream(file_, std::ios::binary);
  Json read = Json::parse(stream, nullptr, false);
  const bool ours =
      read.is_object() && read.value("mode", Json()) == mode && read.contains("points") && read["points"].is_array() &&
      std::all_of(read["points"].begin(), read["points"].end(), [](const Json& p) { return p.is_object(); });
  if (!ours)
    throw Error(ErrorKind::badInput,
                file_.string() + ": it is no record of the mode " + mode + "; choose another folder");
  record_ = std::move(read);
}

const Json* Points::find(const Json& key) const {
  const auto matches = [&](const Json& point) {
    return std::all_of(key.items().begin(), key.items().end(), [&](const auto& item) {
      return point.contains(item.key()) && point[item.key()] == item.value();
    });
  };
  const Json& points = record_["points"];
  const auto found = std::find_if(points.begin(), points.end(), matches);
  return found == points.end() ? nullptr : &*found;
}

void Points::keep(Json point) {
  record_["points"].push_back(std::move(point));
  AtomicFile file(file_);
  file.write(dump(record_));
  file.commit();
}

Json pointKey(const RunStatistics& run, const BenchScene& scene) {
  const Json all = toJson(run);
  const auto vector = [](const glm::vec3& v) { return Json::array({v.x, v.y, v.z}); };
  Json key;
  key["version"] = version();
  for (const char* name : {"device", "scene", "settings"}) key[name] = all[name];
  key["scene"]["mirrors"] = scene.mirrors;
  key["scene"]["camera"] = {{"eye", vector(scene.camera.eye)},
                            {"target", vector(scene.camera.target)},
                            {"fov", glm::degrees(scene.camera.verticalFov)}};
  key["size"] = {run.width, run.height};
  return key;
}

void addMeasured(Json& point, const RunStatistics& run) {
  const Json all = toJson(run);
  for (const char* name : {"pixels", "memory", "overflow", "lost_fragments", "warnings"}) point[name] = all[name];
}

void addTimes(Json& point, const RunStatistics& run) { point["time_ms"] = toJson(run)["time_ms"]; }

OutputFolder::OutputFolder(const fs::path& path) : path_(path) {
  std::error_code error;
  for (fs::path folder = fs::absolute(path).lexically_normal();
       !fs::exists(folder, error) && folder.has_relative_path(); folder = folder.parent_path())
    made_.push_back(folder);
  fs::create_directories(path_, error);
  if (!fs::is_directory(path_)) throw Error(ErrorKind::failed, path_.string() + ": the folder cannot be made");
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  // Only empty folders can be removed so.
  for (const fs::path& folder : made_) fs::remove(folder, ignored);
}

}  // namespace halfsilver::bench
