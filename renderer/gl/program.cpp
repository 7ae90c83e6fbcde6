#include "gl/program.h"

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <utility>

#include <halfsilver/error.h>
#include "gl/shader_files.h"

namespace halfsilver::gl {
namespace {

std::string_view shaderText(std::string_view file) {
  for (const ShaderFile& candidate : shaderFiles())
    if (candidate.path == file) return candidate.text;
  throw Error(ErrorKind::failed, "no embedded shader file " + std::string(file));
}

// Appends a file and what it includes. `files` are those already in the text; a file's place among them is its source
// string number in #line, which is how a compiler's message is brought back to the file.
void append(std::string_view file, std::vector<std::string>& files, std::ostringstream& out) {
  if (std::find(files.begin(), files.end(), file) != files.end()) return;
  const std::size_t self = files.size();
  files.emplace_back(file);
  out << "#line 1 " << self << '\n';
  std::istringstream lines{std::string(shaderText(file))};
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

std::string assemble(std::string_view file, std::span<const Define> defines, std::vector<std::string>& files) {
  std::ostringstream out;
  out << "#version 450 core\n";
  for (const Define& define : defines) out << "#define " << define.name << ' ' << define.value << '\n';
  append(file, files, out);
  return out.str();
}

// The first line of a compiler's message, with the included file that its source string number stands for.
std::string explain(const std::string& log, const std::vector<std::string>& files) {
  const std::string line = log.substr(0, log.find('\n'));
  const std::size_t digits = line.find_first_of("0123456789");
  if (digits == std::string::npos) return line;
  const std::size_t file = static_cast<std::size_t>(std::atoi(line.c_str() + digits));
  return file > 0 && file < files.size() ? "in " + files[file] + ": " + line : line;
}

GLuint compile(const Api& api, const Stage& stage, std::span<const Define> defines) {
  std::vector<std::string> files;
  const std::string source = assemble(stage.file, defines, files);
  const GLuint shader = api.CreateShader(stage.type);
  const char* text = source.c_str();
  api.ShaderSource(shader, 1, &text, nullptr);
  api.CompileShader(shader);
  GLint compiled = 0;
  api.GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled) return shader;
  std::string log(4096, '\0');
  GLsizei length = 0;
  api.GetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), &length, log.data());
  api.DeleteShader(shader);
  log.resize(static_cast<std::size_t>(length));
  throw Error(ErrorKind::failed, "shader " + std::string(stage.file) + " does not compile: " + explain(log, files));
}

}  // namespace

std::string assembleShader(std::string_view file, std::span<const Define> defines) {
  std::vector<std::string> files;
  return assemble(file, defines, files);
}

Program::Program(const Api& api, std::span<const Stage> stages, std::span<const Define> defines) : api_(&api) {
  std::vector<GLuint> shaders;
  const auto release = [&] {
    for (const GLuint shader : shaders) api.DeleteShader(shader);
  };
  try {
    for (const Stage& stage : stages) shaders.push_back(compile(api, stage, defines));
  } catch (...) {
    release();
    throw;
  }
  name_ = api.CreateProgram();
  for (const GLuint shader : shaders) api.AttachShader(name_, shader);
  api.LinkProgram(name_);
  release();
  GLint linked = 0;
  api.GetProgramiv(name_, GL_LINK_STATUS, &linked);
  const std::string label(stages.empty() ? "" : stages.back().file);
  api.ObjectLabel(GL_PROGRAM, name_, -1, label.c_str());
  if (linked) return;
  std::string log(4096, '\0');
  GLsizei length = 0;
  api.GetProgramInfoLog(name_, static_cast<GLsizei>(log.size()), &length, log.data());
  api.DeleteProgram(name_);
  name_ = 0;
  log.resize(static_cast<std::size_t>(length));
  throw Error(ErrorKind::failed, "program " + label + " does not link: " + log.substr(0, log.find('\n')));
}

Program Program::compute(const Api& api, std::string_view file, std::span<const Define> defines) {
  const Stage stages[] = {{GL_COMPUTE_SHADER, file}};
  return Program(api, stages, defines);
}

Program Program::raster(const Api& api, std::string_view vertex, std::string_view fragment,
                        std::span<const Define> defines) {
  const Stage stages[] = {{GL_VERTEX_SHADER, vertex}, {GL_FRAGMENT_SHADER, fragment}};
  return Program(api, stages, defines);
}

Program::~Program() {
  if (name_) api_->DeleteProgram(name_);
}

Program::Program(Program&& other) noexcept : api_(other.api_), name_(std::exchange(other.name_, 0)) {}

Program& Program::operator=(Program&& other) noexcept {
  std::swap(api_, other.api_);
  std::swap(name_, other.name_);
  return *this;
}

void Program::use() const { api_->UseProgram(name_); }

void Program::set(const char* uniform, int value) const {
  api_->ProgramUniform1i(name_, api_->GetUniformLocation(name_, uniform), value);
}
void Program::set(const char* uniform, unsigned value) const {
  api_->ProgramUniform1ui(name_, api_->GetUniformLocation(name_, uniform), value);
}
void Program::set(const char* uniform, float value) const {
  api_->ProgramUniform1f(name_, api_->GetUniformLocation(name_, uniform), value);
}
void Program::set(const char* uniform, const glm::vec2& value) const {
  api_->ProgramUniform2f(name_, api_->GetUniformLocation(name_, uniform), value.x, value.y);
}
void Program::set(const char* uniform, const glm::vec3& value) const {
  api_->ProgramUniform3f(name_, api_->GetUniformLocation(name_, uniform), value.x, value.y, value.z);
}
void Program::set(const char* uniform, const glm::vec4& value) const {
  api_->ProgramUniform4f(name_, api_->GetUniformLocation(name_, uniform), value.x, value.y, value.z, value.w);
}
void Program::set(const char* uniform, const glm::ivec3& value) const {
  api_->ProgramUniform3i(name_, api_->GetUniformLocation(name_, uniform), value.x, value.y, value.z);
}
void Program::set(const char* uniform, const glm::mat4& value) const {
  api_->ProgramUniformMatrix4fv(name_, api_->GetUniformLocation(name_, uniform), 1, GL_FALSE, &value[0][0]);
}

}  // namespace halfsilver::gl
