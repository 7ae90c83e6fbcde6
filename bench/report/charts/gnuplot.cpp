#include "bench/report/charts/gnuplot.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <sstream>

#include <halfsilver/error.h>

namespace halfsilver::bench {
namespace {

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

File temporaryFile() {
  File file(std::tmpfile(), std::fclose);
  if (!file) throw Error(ErrorKind::failed, "cannot create a temporary file for gnuplot");
  return file;
}

}  // namespace

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (static_cast<unsigned char>(c) >= ' ') result += c;
  }
  return result + '"';
}

std::vector<double> logarithmicTicks(double low, double high) {
  const bool few = high < 300 * low;
  const double rounding = 1e-6;
  std::vector<double> ticks;
  for (double decade = std::pow(10.0, std::floor(std::log10(low))); decade <= high * (1 + rounding); decade *= 10)
    for (const double step : {1.0, 2.0, 5.0})
      if (const double tick = step * decade;
          (few || step == 1.0) && tick >= low * (1 - rounding) && tick <= high * (1 + rounding))
        ticks.push_back(tick);
  return ticks;
}

std::string terminal(ChartFormat format, double width, double height) {
  std::ostringstream text;
  text << "set terminal " << (format == ChartFormat::svg ? "svg" : "pngcairo") << " noenhanced size " << width << ','
       << height << " background rgb \"white\" font \"sans,12\"\n";
  return text.str();
}

std::optional<std::string> runGnuplot(const std::string& script) {
  const File input = temporaryFile(), output = temporaryFile();
  std::fwrite(script.data(), 1, script.size(), input.get());
  std::rewind(input.get());
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ::fileno(input.get()), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, ::fileno(output.get()), STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  char name[] = "gnuplot";
  char* arguments[] = {name, nullptr};
  pid_t child = 0;
  const int spawned = ::posix_spawnp(&child, name, &actions, nullptr, arguments, ::environ);
  posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  if (spawned != 0) return std::nullopt;
  if (::waitpid(child, &status, 0) != child || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw Error(ErrorKind::failed, "gnuplot failed to draw a chart");
  std::fseek(output.get(), 0, SEEK_END);
  std::string result(static_cast<std::size_t>(std::max(0L, std::ftell(output.get()))), '\0');
  std::rewind(output.get());
  result.resize(std::fread(result.data(), 1, result.size(), output.get()));
  return result;
}

}  // namespace halfsilver::bench
