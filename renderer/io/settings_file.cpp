#include <halfsilver/io.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <optional>
#include <sstream>

#include <halfsilver/error.h>
#include "io/one_line.h"

// toml++ 3.3 relies on assertions that some files break, such as "[|name]": here they throw, in every kind of build.
namespace halfsilver {
namespace {
struct BrokenAssertion {};
[[noreturn]] void breakOff() { throw BrokenAssertion{}; }
}  // namespace
}  // namespace halfsilver
#undef NDEBUG
#define TOML_ASSERT(condition) ((condition) ? void() : halfsilver::breakOff())
#include <toml++/toml.h>

namespace halfsilver {
namespace {

using Kind = SettingInfo::Kind;

[[noreturn]] void reject(const std::string& name, std::uint32_t line, const std::string& what) {
  throw Error(ErrorKind::badInput, oneLine(name + ":" + std::to_string(line) + ": " + what));
}

std::string expectedType(const SettingInfo& info) {
  switch (info.kind) {
    case Kind::boolean:
      return "true or false";
    case Kind::integer:
      return info.choices.empty() ? "a whole number" : "a whole number or \"" + info.choices.front() + '"';
    case Kind::real:
      return "a number";
    case Kind::choice:
      return "a quoted string";
  }
  return "";
}

// The value as set() takes it; empty if it does not have the setting's type.
std::string valueText(const toml::node& node, const SettingInfo& info) {
  const Kind kind = info.kind;
  if (kind == Kind::boolean && node.is_boolean()) return *node.value<bool>() ? "true" : "false";
  if (node.is_string()) {
    const std::string text = *node.value<std::string>();
    const bool known = std::find(info.choices.begin(), info.choices.end(), text) != info.choices.end();
    return kind == Kind::choice || known ? text : std::string();  // set() says which choices there are
  }
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
    const std::string text = valueText(node, *info);
    if (text.empty()) reject(name_, line, "setting " + full + ": must be " + expectedType(*info));
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

// Names and values are ASCII. What else comments hold is replaced: between values, toml++ 3.3 has no defined behavior
// for some of it.
std::string plain(std::string_view text) {
  constexpr std::string_view kMark = "\xef\xbb\xbf";  // of UTF-8, in front
  std::string result(text.substr(text.starts_with(kMark) ? kMark.size() : 0));
  std::replace_if(
      result.begin(), result.end(), [](unsigned char c) { return c > 127; }, '?');
  return result;
}

// The parser recurses into the parts of a key, as deep as they are many: those that a file needs are two.
// Dots of comments do not count, unless strings of several lines might look like them.
void checkKeys(std::string_view text, const std::string& name) {
  constexpr int kMost = 32;
  const bool comments = text.find("\"\"\"") == text.npos && text.find("'''") == text.npos;
  std::uint32_t line = 1;
  int dots = 0;
  char quote = 0;  // of the string around
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\n') {
      ++line;
      dots = 0;
      quote = 0;
    } else if (quote == 0 && text[i] == '#' && comments) {
      i = std::min(text.find('\n', i), text.size()) - 1;
    } else if (quote == '"' && text[i] == '\\') {
      ++i;
    } else if (quote != 0 ? text[i] == quote : text[i] == '"' || text[i] == '\'') {
      quote = quote != 0 ? char{0} : text[i];
    } else if (text[i] == '.' && !text.substr(i + 1).starts_with('.') && ++dots > kMost) {
      reject(name, line, "a key has more than " + std::to_string(kMost) + " parts");
    }
  }
}

// Nothing if the parser breaks off without saying why.
std::optional<toml::table> parsed(std::string_view text, const std::string& name) try {
  return toml::parse(text, name);
} catch (const BrokenAssertion&) {
  return std::nullopt;
}

std::size_t startOfLine(std::string_view text, std::uint32_t line) {
  std::size_t start = 0;
  for (std::uint32_t i = 1; i < line; ++i) start = text.find('\n', start) + 1;
  return start;
}

// The line that the parser does not survive: the last one of the shortest text that it does not.
std::uint32_t fatalLine(std::string_view text, const std::string& name) {
  std::uint32_t low = 1, high = 1 + static_cast<std::uint32_t>(std::count(text.begin(), text.end(), '\n'));
  while (low < high) {
    const std::uint32_t middle = low + (high - low) / 2;
    bool survived = true;
    try {
      survived = parsed(text.substr(0, startOfLine(text, middle + 1)), name).has_value();
    } catch (const toml::parse_error&) {  // cut off within a value
    }
    (survived ? low : high) = survived ? middle + 1 : middle;
  }
  return low;
}

}  // namespace

void applySettingsText(Settings& settings, std::string_view text, const std::string& name) {
  const std::string ascii = plain(text);
  checkKeys(ascii, name);
  Settings changed = settings;
  try {
    const std::optional<toml::table> root = parsed(ascii, name);
    if (!root) reject(name, fatalLine(ascii, name), "not valid TOML");
    Reader(changed, name).table(*root, "");
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
    const std::string quote = isWord(info) ? "\"" : "";
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
