#include "gpu/shader_function.h"

#include <stdexcept>

#include "gl/program.h"

namespace halfsilver::testing {

ShaderFunction::ShaderFunction(const gl::Api& api, std::string_view file, std::string_view body, int inputStride,
                               int outputStride, std::span<const gl::Define> defines)
    : api_(&api),
      inputStride_(static_cast<std::size_t>(inputStride)),
      outputStride_(static_cast<std::size_t>(outputStride)) {
  const std::string source = gl::assembleShader(file, defines).text +
                             "layout(local_size_x = 64) in;\n"
                             "layout(std430, binding = " +
                             std::to_string(SSBO_RAYS) +
                             ") readonly buffer InputBlock { vec4 inputs[]; };\n"
                             "layout(std430, binding = " +
                             std::to_string(SSBO_HITS) +
                             ") writeonly buffer OutputBlock { vec4 outputs[]; };\n"
                             "uniform uint items;\n"
                             "void main() {\n  uint item = gl_GlobalInvocationID.x;\n"
                             "  if (item >= items) return;\n" +
                             std::string(body) + "\n}\n";
  const GLuint shader = api.CreateShader(GL_COMPUTE_SHADER);
  const char* text = source.c_str();
  api.ShaderSource(shader, 1, &text, nullptr);
  api.CompileShader(shader);
  GLint compiled = 0;
  api.GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (!compiled) {
    std::string log(4096, '\0');
    api.GetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
    throw std::runtime_error(log.c_str());
  }
  program_ = api.CreateProgram();
  api.AttachShader(program_, shader);
  api.LinkProgram(program_);
  api.DeleteShader(shader);
}

ShaderFunction::~ShaderFunction() { api_->DeleteProgram(program_); }

std::vector<glm::vec4> ShaderFunction::run(const std::vector<glm::vec4>& inputs) const {
  const std::size_t items = inputs.size() / inputStride_;
  const gl::Buffer in = gl::makeBuffer(*api_, std::span<const glm::vec4>(inputs), "inputs");
  gl::Buffer out(*api_, items * outputStride_ * sizeof(glm::vec4), "outputs");
  in.bindStorage(SSBO_RAYS);
  out.bindStorage(SSBO_HITS);
  api_->UseProgram(program_);
  api_->ProgramUniform1ui(program_, api_->GetUniformLocation(program_, "items"), static_cast<GLuint>(items));
  api_->DispatchCompute(static_cast<GLuint>((items + 63) / 64), 1, 1);
  // The dispatch writes the outputs; read() copies them.
  api_->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  return out.read<glm::vec4>(items * outputStride_);
}

void addQuad(Scene& scene, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d,
             std::uint32_t material) {
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  const glm::vec3 corners[4] = {a, b, c, d};
  const glm::vec2 uvs[4] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (int i = 0; i < 4; ++i) {
    Vertex vertex;
    vertex.position = corners[i];
    vertex.normal = glm::normalize(glm::cross(b - a, c - a));
    vertex.tangent = glm::vec4(glm::normalize(b - a), 1);
    vertex.uv = {uvs[i], uvs[i]};
    scene.vertices.push_back(vertex);
  }
  scene.triangles.push_back({{first, first + 1, first + 2}, material});
  scene.triangles.push_back({{first, first + 2, first + 3}, material});
}

std::shared_ptr<Texture> plainTexture(int width, int height, const glm::u8vec4& color, bool srgb) {
  auto texture = std::make_shared<Texture>();
  texture->width = width;
  texture->height = height;
  texture->srgb = srgb;
  for (int i = 0; i < width * height; ++i)
    texture->texels.insert(texture->texels.end(), {color.r, color.g, color.b, color.a});
  return texture;
}

std::vector<float> readFloats(const gl::Texture& texture, GLenum format, std::size_t channels) {
  std::vector<float> values(static_cast<std::size_t>(texture.shape().width * texture.shape().height) * channels);
  texture.read(format, GL_FLOAT, values.size() * sizeof(float), values.data());
  return values;
}

std::vector<std::uint32_t> readNumbers(const gl::Texture& texture) {
  std::vector<std::uint32_t> values(static_cast<std::size_t>(texture.shape().width * texture.shape().height));
  texture.read(GL_RED_INTEGER, GL_UNSIGNED_INT, values.size() * sizeof(std::uint32_t), values.data());
  return values;
}

}  // namespace halfsilver::testing
