#include <halfsilver/io.h>

#include <toml++/toml.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <sstream>

#include <halfsilver/error.h>

namespace halfsilver {
namespace {

using Kind = SettingInfo::Kind;

[[noreturn]] void reject(const std::string& name, std::uint32_t line, const std::string& what) {
  throw Error(ErrorKind::badInput, name + ":" + std::to_string(line) + ": " + what);
}

const char* expectedType(Kind kind) {
  switch (kind) {
    case Kind::boolean:
      return "true or false";
    case Kind::integer:
      return "a whole number";
    case Kind::real:
      return "a number";
    case Kind::choice:
      return "a quoted string";
  }
  return "";
}

// The value as set() takes it; empty if it does not have the setting's type.
std::string valueText(const toml::node& node, Kind kind) {
  if (kind == Kind::boolean && node.is_boolean()) return *node.value<bool>() ? "true" : "false";
  if (kind == Kind::choice && node.is_string()) return *node.value<std::string>();
  if ((kind == Kind::integer || kind == Kind::real) && node.is_integer())
    return std::to_string(*node.value<std::int64_t>());
  if (kind == Kind::real && node.is_floating_point()) {
    char text[32];
    std::snprintf(text, sizeof(text), "%.9g", *node.value<double>());
    return text;
  }
  return {};
}

class Reader {
 public:
  Reader(Settings& settings, const std::string& name) : settings_(settings), name_(name), known_(describe(settings)) {}

  void table(const toml::table& table, const std::string& prefix) {
    for (const auto& [key, node] : table) {
      const std::string full = prefix.empty() ? std::string(key.str()) : prefix + "." + std::string(key.str());
      if (const toml::table* section = node.as_table()) {
        if (!isSection(full)) reject(name_, key.source().begin.line, "unknown section [" + full + "]");
        this->table(*section, full);
      } else {
        value(full, node, key.source().begin.line);
      }
    }
  }

 private:
  bool isSection(const std::string& name) const {
    return std::any_of(known_.begin(), known_.end(),
                       [&](const SettingInfo& info) { return info.name.starts_with(name + "."); });
  }

  void value(const std::string& full, const toml::node& node, std::uint32_t line) {
    const auto info = std::find_if(known_.begin(), known_.end(), [&](const auto& i) { return i.name == full; });
    if (info == known_.end()) reject(name_, line, "unknown setting '" + full + "'");
    const std::string text = valueText(node, info->kind);
    if (text.empty()) reject(name_, line, "setting " + full + ": must be " + expectedType(info->kind));
    try {
      set(settings_, full, text);
    } catch (const Error& error) {
      reject(name_, line, error.what());
    }
  }

  Settings& settings_;
  const std::string& name_;
  std::vector<SettingInfo> known_;
};

std::string firstComment(std::string_view text) {
  if (!text.starts_with("# ")) return {};
  return std::string(text.substr(2, text.find('\n') - 2));
}

}  // namespace

void applySettingsText(Settings& settings, std::string_view text, const std::string& name) {
  Settings changed = settings;
  try {
    Reader(changed, name).table(toml::parse(text, name), "");
  } catch (const toml::parse_error& error) {
    reject(name, error.source().begin.line, std::string(error.description()));
  }
  settings = changed;
}

void applySettingsFile(Settings& settings, const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) throw Error(ErrorKind::badInput, file.string() + ": no such file");
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  if (!std::filesystem::is_regular_file(file, error) || !(text << stream.rdbuf())) {
    const bool empty = std::filesystem::is_regular_file(file, error) && std::filesystem::file_size(file, error) == 0;
    if (!empty || error) throw Error(ErrorKind::badInput, file.string() + ": cannot be read");
  }
  applySettingsText(settings, text.str(), file.string());
}

std::string settingsText(const Settings& settings, std::span<const std::string> always) {
  const std::vector<SettingInfo> values = describe(settings), defaults = describe(Settings{});
  std::string text, section;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const SettingInfo& info = values[i];
    const bool wanted =
        info.value != defaults[i].value || std::find(always.begin(), always.end(), info.name) != always.end();
    if (!wanted) continue;
    const std::size_t dot = info.name.find('.');
    if (info.name.substr(0, dot) != section) {
      section = info.name.substr(0, dot);
      text += (text.empty() ? "[" : "\n[") + section + "]\n";
    }
    const std::string quote = info.kind == Kind::choice ? "\"" : "";
    text += info.name.substr(dot + 1) + " = " + quote + info.value + quote + '\n';
  }
  return text;
}

std::vector<Preset> presets() {
  std::vector<Preset> result;
  const std::vector<SettingInfo> defaults = describe(Settings{});
  for (const PresetFile& file : presetFiles()) {
    Settings settings;
    applySettingsText(settings, file.text, "preset " + std::string(file.name));
    Preset preset{std::string(file.name), firstComment(file.text), {}};
    const std::vector<SettingInfo> values = describe(settings);
    for (std::size_t i = 0; i < values.size(); ++i)
      if (values[i].value != defaults[i].value) preset.values.emplace_back(values[i].name, values[i].value);
    result.push_back(std::move(preset));
  }
  std::sort(result.begin(), result.end(), [](const Preset& a, const Preset& b) { return a.name < b.name; });
  return result;
}

void applyPreset(Settings& settings, std::string_view name) {
  std::string known;
  for (const PresetFile& file : presetFiles()) {
    if (file.name == name) return applySettingsText(settings, file.text, "preset " + std::string(name));
    known += (known.empty() ? "" : ", ") + std::string(file.name);
  }
  throw Error(ErrorKind::usage, "unknown preset '" + std::string(name) + "'; known are " + known);
}

}  // namespace halfsilver
