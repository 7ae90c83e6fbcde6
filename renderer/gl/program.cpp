#include "gl/program.h"

#include <algorithm>
#include <cctype>
#include <functional>
#include <map>
#include <utility>

#include <halfsilver/error.h>
#include "gl/program_cache.h"

namespace halfsilver::gl {
namespace {

// The device's limit of storage blocks in a stage, in words.
struct StageLimit {
  GLint blocks;
  const char* shaders;
};

StageLimit storageLimit(const Limits& limits, GLenum stage) {
  switch (stage) {
    case GL_VERTEX_SHADER:
      return {limits.vertexStorageBlocks, " storage blocks in vertex shaders"};
    case GL_FRAGMENT_SHADER:
      return {limits.fragmentStorageBlocks, " storage blocks in fragment shaders"};
    default:
      return {limits.computeStorageBlocks, " storage blocks in compute shaders"};
  }
}

std::string firstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

template <class GetLog>
std::string readLog(const GetLog& getLog) {
  std::string log(4096, '\0');
  GLsizei length = 0;
  getLog(static_cast<GLsizei>(log.size()), &length, log.data());
  log.resize(static_cast<std::size_t>(length));
  return log;
}

void attach(const Api& api, GLuint program, const Stage& stage, const ShaderSource& source) {
  const GLuint shader = api.CreateShader(stage.type);
  api.AttachShader(program, shader);
  api.DeleteShader(shader);  // goes with the program
  const char* text = source.text.c_str();
  api.ShaderSource(shader, 1, &text, nullptr);
  api.CompileShader(shader);
  GLint compiled = 0;
  api.GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled) return;
  const std::string log =
      readLog([&](GLsizei size, GLsizei* length, char* out) { api.GetShaderInfoLog(shader, size, length, out); });
  throw Error(ErrorKind::failed, "shader " + stage.file + " does not compile: " + source.explain(log));
}

// A driver that enforces its limit does not link the program, and only its message says why.
bool speaksOfStorageBlocks(std::string log) {
  std::transform(log.begin(), log.end(), log.begin(), [](unsigned char c) { return std::tolower(c); });
  return log.find("storage block") != std::string::npos || log.find("storage buffer") != std::string::npos;
}

bool linked(const Api& api, GLuint program) {
  GLint status = 0;
  api.GetProgramiv(program, GL_LINK_STATUS, &status);
  return status != 0;
}

void requireLinked(const Api& api, GLuint program, const std::string& label, std::span<const Stage> stages) {
  if (linked(api, program)) return;
  const std::string log =
      readLog([&](GLsizei size, GLsizei* length, char* out) { api.GetProgramInfoLog(program, size, length, out); });
  if (!speaksOfStorageBlocks(log))
    throw Error(ErrorKind::failed, "program " + label + " does not link: " + firstLine(log));
  std::string offered;
  for (const Stage& stage : stages) {
    const StageLimit limit = storageLimit(api.limits, stage.type);
    offered += (offered.empty() ? "" : " and ") + std::to_string(limit.blocks) + limit.shaders;
  }
  throw Error(ErrorKind::noContext,
              "the GL device offers " + offered + ", program " + label + " needs more: " + firstLine(log));
}

GLint activeStorageBlocks(const Api& api, GLuint program) {
  GLint blocks = 0;
  api.GetProgramInterfaceiv(program, GL_SHADER_STORAGE_BLOCK, GL_ACTIVE_RESOURCES, &blocks);
  return blocks;
}

// The storage blocks of one stage of a program that has `all` of them: those of the stage linked by itself.
// GL_REFERENCED_BY_VERTEX_SHADER and so on would say it, but Mesa 22 denies blocks whose index is not constant.
GLint storageBlocksOf(const Api& api, const Stage& stage, std::span<const Define> defines, GLint all) {
  const GLuint alone = api.CreateProgram();
  api.ProgramParameteri(alone, GL_PROGRAM_SEPARABLE, GL_TRUE);  // so that its inputs and outputs count as used
  attach(api, alone, stage, assembleShader(stage.file, defines));
  api.LinkProgram(alone);
  const GLint blocks = linked(api, alone) ? activeStorageBlocks(api, alone) : all;
  api.DeleteProgram(alone);
  return blocks;
}

void requireStorageBlocks(const Api& api, GLuint program, const std::string& label, std::span<const Stage> stages,
                          std::span<const Define> defines) {
  const GLint all = activeStorageBlocks(api, program);
  for (const Stage& stage : stages) {
    const StageLimit limit = storageLimit(api.limits, stage.type);
    if (all <= limit.blocks) continue;
    const GLint needed = stages.size() == 1 ? all : storageBlocksOf(api, stage, defines, all);
    if (needed > limit.blocks)
      throw Error(ErrorKind::noContext, "the GL device offers " + std::to_string(limit.blocks) + limit.shaders +
                                            ", program " + label + " needs " + std::to_string(needed));
  }
}

GLuint compile(const Api& api, const std::string& label, std::span<const Stage> stages,
               std::span<const ShaderSource> sources) {
  const GLuint program = api.CreateProgram();
  if (keepsPrograms(api)) api.ProgramParameteri(program, GL_PROGRAM_BINARY_RETRIEVABLE_HINT, GL_TRUE);
  try {
    for (std::size_t i = 0; i < stages.size(); ++i) attach(api, program, stages[i], sources[i]);
    api.LinkProgram(program);
    requireLinked(api, program, label, stages);
  } catch (...) {
    api.DeleteProgram(program);
    throw;
  }
  ++api.programCounts->compiled;
  return program;
}

GLuint link(const Api& api, std::span<const Stage> stages, std::span<const Define> defines) {
  const std::string label(stages.empty() ? "" : stages.back().file);
  std::vector<ShaderSource> sources;
  ProgramKey key(api);
  for (const Stage& stage : stages) key.add(stage.type, sources.emplace_back(assembleShader(stage.file, defines)).text);
  GLuint program = loadProgram(api, key);
  if (program) {
    ++api.programCounts->cached;
  } else {
    program = compile(api, label, stages, sources);
    storeProgram(api, program, key);
  }
  try {
    requireStorageBlocks(api, program, label, stages, defines);
  } catch (...) {
    api.DeleteProgram(program);
    throw;
  }
  api.ObjectLabel(GL_PROGRAM, program, -1, label.c_str());
  return program;
}

// Calls glProgramUniform* for the type of the value.
struct UniformSetter {
  const Api& api;
  GLuint program;
  GLint location;

  void operator()(int v) const { api.ProgramUniform1i(program, location, v); }
  void operator()(unsigned v) const { api.ProgramUniform1ui(program, location, v); }
  void operator()(float v) const { api.ProgramUniform1f(program, location, v); }
  void operator()(const glm::vec2& v) const { api.ProgramUniform2f(program, location, v.x, v.y); }
  void operator()(const glm::vec3& v) const { api.ProgramUniform3f(program, location, v.x, v.y, v.z); }
  void operator()(const glm::vec4& v) const { api.ProgramUniform4f(program, location, v.x, v.y, v.z, v.w); }
  void operator()(const glm::ivec3& v) const { api.ProgramUniform3i(program, location, v.x, v.y, v.z); }
  void operator()(const glm::mat4& v) const { api.ProgramUniformMatrix4fv(program, location, 1, GL_FALSE, &v[0][0]); }
};

}  // namespace

struct LinkedProgram {
  struct Uniform {
    GLint location;
    UniformValue value;
  };

  LinkedProgram(const Api& table, std::span<const Stage> stageList, std::span<const Define> defineList)
      : api(&table),
        stages(stageList.begin(), stageList.end()),
        defines(defineList.begin(), defineList.end()),
        name(link(table, stages, defines)) {}
  ~LinkedProgram() { api->DeleteProgram(name); }
  LinkedProgram(const LinkedProgram&) = delete;
  LinkedProgram& operator=(const LinkedProgram&) = delete;

  GLint location(const std::string& uniform) const { return api->GetUniformLocation(name, uniform.c_str()); }

  void set(std::string_view uniform, const UniformValue& value) {
    auto known = uniforms.find(uniform);
    if (known == uniforms.end()) {
      const std::string text(uniform);
      known = uniforms.emplace(text, Uniform{location(text), {}}).first;
    }
    known->second.value = value;
    std::visit(UniformSetter{*api, name, known->second.location}, value);
  }

  void reload() {
    const GLuint old = std::exchange(name, link(*api, stages, defines));
    api->DeleteProgram(old);
    for (auto& [text, uniform] : uniforms) {
      uniform.location = location(text);
      std::visit(UniformSetter{*api, name, uniform.location}, uniform.value);
    }
  }

  const Api* api;
  std::vector<Stage> stages;
  std::vector<Define> defines;
  GLuint name;
  std::map<std::string, Uniform, std::less<>> uniforms;  // those that have been set
};

Program::Program(const Api& api, std::span<const Stage> stages, std::span<const Define> defines)
    : linked_(std::make_shared<LinkedProgram>(api, stages, defines)) {
  std::erase_if(*api.programs, [](const std::weak_ptr<LinkedProgram>& program) { return program.expired(); });
  api.programs->push_back(linked_);
}

Program Program::compute(const Api& api, std::string_view file, std::span<const Define> defines) {
  const Stage stages[] = {{GL_COMPUTE_SHADER, std::string(file)}};
  return Program(api, stages, defines);
}

Program Program::raster(const Api& api, std::string_view vertex, std::string_view fragment,
                        std::span<const Define> defines) {
  const Stage stages[] = {{GL_VERTEX_SHADER, std::string(vertex)}, {GL_FRAGMENT_SHADER, std::string(fragment)}};
  return Program(api, stages, defines);
}

void Program::use() const { linked_->api->UseProgram(linked_->name); }

void Program::set(std::string_view uniform, const UniformValue& value) const { linked_->set(uniform, value); }

std::vector<std::string> reloadPrograms(const Api& api) {
  std::vector<std::string> errors;
  for (const std::weak_ptr<LinkedProgram>& entry : *api.programs) {
    const std::shared_ptr<LinkedProgram> program = entry.lock();
    if (!program) continue;
    try {
      program->reload();
    } catch (const Error& error) {
      // Variants of a program share their errors.
      if (std::find(errors.begin(), errors.end(), error.what()) == errors.end()) errors.emplace_back(error.what());
    }
  }
  return errors;
}

}  // namespace halfsilver::gl
