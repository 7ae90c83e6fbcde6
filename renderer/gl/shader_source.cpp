#include "gl/shader_source.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>

#include <halfsilver/error.h>
#include "gl/shader_files.h"

namespace halfsilver::gl {
namespace {

std::string readFile(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  if (!in) throw Error(ErrorKind::failed, "cannot read the shader file " + path + " (HALFSILVER_SHADERS)");
  return text;
}

std::string shaderText(std::string_view file) {
  const char* folder = std::getenv("HALFSILVER_SHADERS");
  if (folder && *folder) return readFile(std::string(folder) + '/' + std::string(file));
  for (const ShaderFile& candidate : shaderFiles())
    if (candidate.path == file) return std::string(candidate.text);
  throw Error(ErrorKind::failed, "no embedded shader file " + std::string(file));
}

// Appends a file and what it includes, unless the text has it already.
void append(std::string_view file, std::vector<std::string>& files, std::ostringstream& out) {
  if (std::find(files.begin(), files.end(), file) != files.end()) return;
  const std::size_t self = files.size();
  files.emplace_back(file);
  out << "#line 1 " << self << '\n';
  std::istringstream lines{shaderText(file)};
  const std::string include = "#include \"";
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (line.rfind("#version", 0) == 0 || line.rfind("#pragma once", 0) == 0) {
      out << '\n';
    } else if (line.rfind(include, 0) == 0) {
      const std::size_t end = line.find('"', include.size());
      append(line.substr(include.size(), end - include.size()), files, out);
      out << "#line " << number + 1 << ' ' << self << '\n';
    } else {
      out << line << '\n';
    }
  }
}

}  // namespace

ShaderSource assembleShader(std::string_view file, std::span<const Define> defines) {
  ShaderSource source;
  std::ostringstream out;
  out << "#version 450 core\n";
  for (const Define& define : defines) out << "#define " << define.name << ' ' << define.value << '\n';
  append(file, source.files, out);
  source.text = out.str();
  return source;
}

std::string ShaderSource::explain(const std::string& log) const {
  const std::string line = log.substr(0, log.find('\n'));
  const std::size_t digits = line.find_first_of("0123456789");
  if (digits == std::string::npos) return line;
  const std::size_t file = static_cast<std::size_t>(std::atoi(line.c_str() + digits));
  return file > 0 && file < files.size() ? "in " + files[file] + ": " + line : line;
}

}  // namespace halfsilver::gl
