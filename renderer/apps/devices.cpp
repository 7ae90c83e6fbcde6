#include "apps/devices.h"

#include <algorithm>
#include <iostream>
#include <string>
#include <vector>

#include <halfsilver/context.h>
#include <halfsilver/error.h>
#include <halfsilver/gl/api.h>
#include "apps/statistics.h"
#include "gl/limits.h"

namespace halfsilver {
namespace {

using Json = nlohmann::ordered_json;

// What the device says of itself, or why it is refused.
Json deviceJson(std::size_t number, const ContextDevice& device) {
  Json json = {{"number", number}, {"name", device.name}};
  if (!device.lacks.empty()) {
    json["refused"] = device.lacks;
    return json;
  }
  try {
    const Context context = makeContext(ContextKind::automatic, {.device = std::to_string(number)});
    const gl::Api api = gl::Api::load(context.getProcAddress());
    json["vendor"] = api.vendor;
    json["renderer"] = api.renderer;
    json["version"] = api.version;
    json["software"] = api.software;
    json["limits"] = Json::array();
    for (const gl::Need& need : gl::needsOf(api.limits)) {
      Json limit = {{"what", need.what}, {"offered", need.offered}};
      if (need.least > 0) limit["least"] = need.least;
      if (need.used > 0) limit["used"] = need.used;
      json["limits"].push_back(std::move(limit));
    }
  } catch (const Error& error) {
    json["refused"] = error.what();
  }
  return json;
}

void print(const Json& device) {
  std::cout << device["number"] << "  " << device["name"].get<std::string>() << ": ";
  if (device.contains("refused")) {
    std::cout << "refused: " << device["refused"].get<std::string>() << '\n';
    return;
  }
  std::cout << device["renderer"].get<std::string>() << ", " << device["vendor"].get<std::string>() << ", OpenGL "
            << device["version"].get<std::string>() << (device["software"] ? ", software" : "") << '\n';
  constexpr std::size_t kColumn = 38;
  for (const Json& limit : device["limits"]) {
    std::string what = limit["what"];
    what.resize(std::max(kColumn, what.size() + 1), ' ');
    std::cout << "   " << what << limit["offered"];
    if (limit.contains("used")) std::cout << " (the default uses " << limit["used"] << ")";
    if (limit.contains("used") && limit["used"] > limit["offered"]) std::cout << ": too few";
    std::cout << '\n';
  }
}

}  // namespace

void showDevices(bool json) {
  const std::vector<ContextDevice> devices = contextDevices();
  Json list = Json::array();
  for (std::size_t i = 0; i < devices.size(); ++i) list.push_back(deviceJson(i, devices[i]));
  const bool usable =
      std::any_of(list.begin(), list.end(), [](const Json& device) { return !device.contains("refused"); });
  if (!usable) {
    std::string lacks;
    for (const Json& device : list)
      lacks +=
          (lacks.empty() ? "" : "; ") + device["name"].get<std::string>() + ": " + device["refused"].get<std::string>();
    throw Error(ErrorKind::noContext, "no device can be used: " + lacks);
  }
  if (json) {
    std::cout << dump({{"devices", list}});
    return;
  }
  for (const Json& device : list) print(device);
}

}  // namespace halfsilver
