#include "bench/harness/json_values.h"

#include <string>

#include "apps/statistics.h"

void nlohmann::adl_serializer<halfsilver::Settings>::to_json(ordered_json& json, const halfsilver::Settings& settings) {
  halfsilver::RunStatistics run;
  run.settings = settings;
  json = halfsilver::toJson(run).at("settings");
}

void nlohmann::adl_serializer<halfsilver::Settings>::from_json(const ordered_json& json,
                                                               halfsilver::Settings& settings) {
  for (const auto& [name, value] : json.items())
    set(settings, name, value.is_string() ? value.get<std::string>() : value.dump());
}
