#include "apps/light_argument.h"

#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <vector>

#include <halfsilver/error.h>

namespace halfsilver {
namespace {

struct Form {
  LightType type;
  std::string_view kind, fields;
};

constexpr std::array kForms = {Form{LightType::directional, "directional", "DX,DY,DZ:R,G,B"},
                               Form{LightType::point, "point", "X,Y,Z:R,G,B"},
                               Form{LightType::sphere, "sphere", "X,Y,Z:RADIUS:R,G,B"},
                               Form{LightType::rectangle, "rectangle", "X,Y,Z:UX,UY,UZ:VX,VY,VZ:R,G,B"}};

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == text.npos) return parts;
    text.remove_prefix(end + 1);
  }
}

[[noreturn]] void reject(std::string_view text, const std::string& why) {
  throw Error(ErrorKind::usage, "--light '" + std::string(text) + "' " + why);
}

const Form& formOf(std::string_view kind, std::string_view text) {
  std::string known;
  for (const Form& form : kForms) {
    if (form.kind == kind) return form;
    known += (known.empty() ? "" : ", ") + std::string(form.kind);
  }
  reject(text, "is of no known kind; known are " + known);
}

// All numbers of the fields behind the kind, which must be as many per field as the form says.
std::vector<double> numbersOf(std::string_view text, const Form& form) {
  constexpr double kLargest = 1e15;
  const std::string expected = "is not " + std::string(form.kind) + ":" + std::string(form.fields);
  const std::vector<std::string_view> wanted = split(form.fields, ':');
  const std::vector<std::string_view> fields = split(text.substr(form.kind.size() + 1), ':');
  if (fields.size() != wanted.size()) reject(text, expected);
  std::vector<double> numbers;
  for (std::size_t f = 0; f < fields.size(); ++f) {
    const std::vector<std::string_view> parts = split(fields[f], ',');
    if (parts.size() != split(wanted[f], ',').size()) reject(text, expected);
    for (const std::string_view part : parts) {
      const char* end = part.data() + part.size();
      const auto parsed = std::from_chars(part.data(), end, numbers.emplace_back());
      if (parsed.ec != std::errc() || parsed.ptr != end || !(std::abs(numbers.back()) <= kLargest))
        reject(text, expected + " with finite numbers");
    }
  }
  return numbers;
}

void placeRectangle(Light& light, const glm::dvec3& u, const glm::dvec3& v, std::string_view text) {
  constexpr double kRight = 1e-4;  // cosine
  const double width = glm::length(u), height = glm::length(v);
  if (!(width > 0 && height > 0) || std::abs(glm::dot(u, v)) > kRight * width * height)
    reject(text, "is no rectangle: its half edges must be perpendicular and longer than 0");
  light.direction = glm::vec3(glm::normalize(glm::cross(u, v)));
  light.up = glm::vec3(v / height);
  light.width = static_cast<float>(2 * width);
  light.height = static_cast<float>(2 * height);
}

}  // namespace

LightArgument parseLight(std::string_view text) {
  const Form& form = formOf(text.substr(0, text.find(':')), text);
  if (text.size() == form.kind.size())
    reject(text, "is not " + std::string(form.kind) + ":" + std::string(form.fields));
  const std::vector<double> n = numbersOf(text, form);
  const auto vectorAt = [&](std::size_t i) { return glm::dvec3(n[i], n[i + 1], n[i + 2]); };
  LightArgument result;
  Light& light = result.light;
  light.type = form.type;
  light.color = glm::vec3(vectorAt(n.size() - 3));
  if (light.color.r < 0 || light.color.g < 0 || light.color.b < 0) reject(text, "has a negative color");
  if (form.type == LightType::directional) {
    const glm::dvec3 direction = vectorAt(0);
    if (!(glm::length(direction) > 0)) reject(text, "has no direction");
    light.direction = glm::vec3(glm::normalize(direction));
    return result;
  }
  result.position = vectorAt(0);
  if (form.type == LightType::sphere) {
    if (!(n[3] > 0)) reject(text, "has a radius that is not above 0");
    light.radius = static_cast<float>(n[3]);
  }
  if (form.type == LightType::rectangle) placeRectangle(light, vectorAt(3), vectorAt(6), text);
  return result;
}

}  // namespace halfsilver
