#pragma once

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

#include <halfsilver/settings.h>
#include "apps/arguments.h"

// How values of other rooms are written in a point.

template <>
struct nlohmann::adl_serializer<glm::vec3> {
  static void to_json(ordered_json& json, const glm::vec3& v) { json = {v.x, v.y, v.z}; }
  static void from_json(const ordered_json& json, glm::vec3& v) {
    v = {json.at(0).get<float>(), json.at(1).get<float>(), json.at(2).get<float>()};
  }
};

template <>
struct nlohmann::adl_serializer<halfsilver::Size> {
  static void to_json(ordered_json& json, const halfsilver::Size& size) { json = {size.width, size.height}; }
  static void from_json(const ordered_json& json, halfsilver::Size& size) {
    size = {json.at(0).get<int>(), json.at(1).get<int>()};
  }
};

// By their names.
template <>
struct nlohmann::adl_serializer<halfsilver::Settings> {
  static void to_json(ordered_json& json, const halfsilver::Settings& settings);
  static void from_json(const ordered_json& json, halfsilver::Settings& settings);
};
