#include "bench/harness/points.h"

#include <algorithm>
#include <fstream>
#include <system_error>
#include <utility>

#include <halfsilver/error.h>
#include "apps/statistics.h"
#include "io/atomic_file.h"

namespace halfsilver::bench {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kMode = "mode";
constexpr const char* kPoints = "points";

}  // namespace

Points::Points(fs::path file, std::string mode) : file_(std::move(file)) {
  record_[kMode] = mode;
  record_[kPoints] = Json::array();
  const AtomicFile writable(file_);
  std::error_code error;
  if (!fs::exists(file_, error)) return;
  std::ifstream stream(file_, std::ios::binary);
  Json read = Json::parse(stream, nullptr, false);
  const auto isObject = [](const Json& point) { return point.is_object(); };
  const bool valid = read.is_object() && read.value(kMode, Json()) == mode && read.contains(kPoints) &&
                     read[kPoints].is_array() && std::all_of(read[kPoints].begin(), read[kPoints].end(), isObject);
  if (!valid)
    throw Error(ErrorKind::badInput, file_.string() + ": not a record of the mode " + mode + "; choose another folder");
  record_ = std::move(read);
}

const Json* Points::find(const Json& key) const {
  const auto matches = [&](const Json& point) {
    return std::all_of(key.items().begin(), key.items().end(), [&](const auto& item) {
      return point.contains(item.key()) && point[item.key()] == item.value();
    });
  };
  const Json& points = record_[kPoints];
  const auto found = std::find_if(points.begin(), points.end(), matches);
  return found == points.end() ? nullptr : &*found;
}

void Points::keep(Json point) {
  record_[kPoints].push_back(std::move(point));
  AtomicFile file(file_);
  file.write(dump(record_));
  file.commit();
}

}  // namespace halfsilver::bench
