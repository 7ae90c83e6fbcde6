#include "apps/method_choice.h"

#include <algorithm>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <system_error>

#include <halfsilver/cache_folder.h>
#include <halfsilver/methods.h>

namespace halfsilver {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMaxChoices = 256;  // beyond it, the oldest are dropped

Json readChoices(const std::filesystem::path& file) {
  std::ifstream in(file);
  Json choices = in ? Json::parse(in, nullptr, false) : Json();
  return choices.is_object() ? choices : Json::object();
}

// A choice as it was written; nothing if the file is not what this program writes.
std::optional<MethodChoice> known(const Json& choices, const std::string& key) {
  const auto entry = choices.find(key);
  if (entry == choices.end() || !entry->is_object()) return std::nullopt;
  const auto method = entry->find("method"), reason = entry->find("reason");
  if (method == entry->end() || !method->is_string() || reason == entry->end() || !reason->is_string())
    return std::nullopt;
  const auto infos = methods();
  const bool exact = std::any_of(infos.begin(), infos.end(), [&](const MethodInfo& info) {
    return info.exact && info.name == method->get<std::string>();
  });
  if (!exact) return std::nullopt;
  return MethodChoice{*method, *reason, {}};
}

void write(const std::filesystem::path& file, const Json& choices) {
  std::error_code ignored;
  std::filesystem::create_directories(file.parent_path(), ignored);
  std::filesystem::path temporary = file;
  temporary += std::to_string(std::random_device()()) + ".tmp";
  std::ofstream out(temporary);
  const bool written = static_cast<bool>(out << choices.dump(1, ' ', false, Json::error_handler_t::replace) << '\n');
  out.close();
  if (written && out) std::filesystem::rename(temporary, file, ignored);
  std::filesystem::remove(temporary, ignored);
}

}  // namespace

std::string ChoiceKey::text() const {
  std::string text = device + " | " + version + " | " + methods + " | " + scene + " | " + std::to_string(triangles) +
                     " triangles" + (moves ? " in motion | " : " | ") + std::to_string(width) + "x" +
                     std::to_string(height) + " | " + std::to_string(std::hash<std::string>()(rest));
  for (char& c : text)
    if (static_cast<unsigned char>(c) >= 0x80) c = '?';  // JSON has UTF-8 alone
  return text + " | " + std::to_string(std::hash<std::string>()(scene));
}

std::filesystem::path choicesFile() {
  const std::filesystem::path folder = cacheFolder();
  return folder.empty() ? folder : folder / "methods.json";
}

MethodChoice rememberedChoice(const std::filesystem::path& file, const ChoiceKey& key,
                              const std::function<MethodChoice()>& choose) {
  Json choices = file.empty() ? Json::object() : readChoices(file);
  if (std::optional<MethodChoice> choice = known(choices, key.text())) {
    choice->reason += " (remembered)";
    return *choice;
  }
  MethodChoice choice = choose();
  if (file.empty() || choice.measured.empty()) return choice;
  while (choices.size() >= kMaxChoices) choices.erase(choices.begin());
  choices[key.text()] = {{"method", choice.method}, {"reason", choice.reason}};
  write(file, choices);
  return choice;
}

}  // namespace halfsilver
