#include "apps/demo/game/recording.h"

#include <charconv>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>
#include <system_error>

#include <halfsilver/error.h>

namespace halfsilver::demo {
namespace {

constexpr std::size_t kMaxSteps = 24 * 3600 * kStepsPerSecond;  // a day

std::vector<std::string_view> words(std::string_view line) {
  std::vector<std::string_view> found;
  while (true) {
    const std::size_t begin = line.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos) return found;
    line.remove_prefix(begin);
    const std::size_t end = std::min(line.find_first_of(" \t\r"), line.size());
    found.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
}

template <class Whole>
std::optional<Whole> whole(std::string_view word, long long low = std::numeric_limits<Whole>::min(),
                           long long high = std::numeric_limits<Whole>::max()) {
  long long value = 0;
  const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (failure != std::errc() || end != word.data() + word.size() || value < low || value > high) return {};
  return static_cast<Whole>(value);
}

}  // namespace

std::string toText(const Recording& recording) {
  std::ostringstream text;
  text << "halfsilver-recording 1\nsteps-per-second " << kStepsPerSecond << "\nseed " << recording.seed << '\n';
  for (std::size_t i = 0; i < recording.inputs.size();) {
    const Input& input = recording.inputs[i];
    std::size_t end = i + 1;
    while (end < recording.inputs.size() && recording.inputs[end] == input) ++end;
    text << end - i << ' ' << int{input.moveX} << ' ' << int{input.moveY} << ' ' << input.lookX << ' ' << input.lookY
         << ' ' << input.buttons << '\n';
    i = end;
  }
  return std::move(text).str();
}

Recording parseRecording(std::string_view text, const std::string& name) {
  Recording recording;
  int number = 0, read = 0;  // lines of the file, and those that say something
  const auto refuse = [&](const std::string& why) {
    throw Error(ErrorKind::badInput, name + ": line " + std::to_string(number) + ": " + why);
  };
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::vector<std::string_view> line = words(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    ++number;
    if (line.empty() || line.front().front() == '#') continue;
    const bool pair = line.size() == 2;
    switch (read++) {
      case 0:
        if (!pair || line[0] != "halfsilver-recording") refuse("not a recording of the game");
        if (line[1] != "1") refuse("version " + std::string(line[1]) + " is not known; this program reads version 1");
        continue;
      case 1:
        if (!pair || line[0] != "steps-per-second" || line[1] != std::to_string(kStepsPerSecond))
          refuse("expected 'steps-per-second " + std::to_string(kStepsPerSecond) + "'");
        continue;
      case 2: {
        const auto seed = pair && line[0] == "seed" ? whole<std::uint32_t>(line[1]) : std::nullopt;
        if (!seed) refuse("expected 'seed N'");
        recording.seed = *seed;
        continue;
      }
      default:
        break;
    }
    if (line.size() != 6) refuse("expected six numbers");
    const auto count = whole<std::uint32_t>(line[0], 1);
    const auto moveX = whole<std::int8_t>(line[1], -127), moveY = whole<std::int8_t>(line[2], -127);
    const auto lookX = whole<std::int16_t>(line[3]), lookY = whole<std::int16_t>(line[4]);
    const auto buttons = whole<std::uint16_t>(line[5]);
    if (!count || !moveX || !moveY || !lookX || !lookY || !buttons) refuse("a number is not whole or out of range");
    if (*count > kMaxSteps - recording.inputs.size()) refuse("more than a day of play");
    recording.inputs.insert(recording.inputs.end(), *count, Input{*moveX, *moveY, *lookX, *lookY, *buttons});
  }
  if (read < 3) throw Error(ErrorKind::badInput, name + ": not a recording of the game, or cut off");
  return recording;
}

void writeRecording(const std::filesystem::path& file, const Recording& recording) {
  std::filesystem::path temporary = file;
  temporary += ".part";
  std::error_code failure;
  {
    std::ofstream out(temporary, std::ios::binary);
    out << toText(recording);
    out.close();
    if (!out) failure = std::make_error_code(std::errc::io_error);
  }
  if (!failure) std::filesystem::rename(temporary, file, failure);
  if (!failure) return;
  std::error_code ignored;
  std::filesystem::remove(temporary, ignored);
  throw Error(ErrorKind::failed, file.string() + ": cannot be written");
}

Recording readRecording(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) throw Error(ErrorKind::badInput, file.string() + ": cannot be read");
  return parseRecording(text.view(), file.string());
}

}  // namespace halfsilver::demo
