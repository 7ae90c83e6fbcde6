#include <halfsilver/io.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <new>
#include <nlohmann/json.hpp>

#include <halfsilver/error.h>
#include "io/gltf_build.h"
#include "io/gltf_check.h"
#include "io/gltf_container.h"
#include "io/gltf_decompress.h"
#include "io/gltf_load.h"
#include "io/gltf_parse.h"

namespace halfsilver {
namespace gltf {
namespace {

std::vector<std::uint8_t> readFile(const std::filesystem::path& path, const Diagnostics& diagnostics) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) diagnostics.fail("there is no such file", "");
  if (!std::filesystem::is_regular_file(status)) diagnostics.fail("is not a file", "");
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) diagnostics.fail("cannot be read", error.message());
  if (size == 0) diagnostics.fail("is empty", "");
  if (size > std::numeric_limits<std::int32_t>::max()) diagnostics.fail("is larger than 2 GiB", "");
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size));
  std::ifstream stream(path, std::ios::binary);
  if (!stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size)))
    diagnostics.fail("cannot be read", "");
  return bytes;
}

Document readDocument(std::span<const std::uint8_t> bytes, const std::filesystem::path& folder,
                      Diagnostics& diagnostics) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const bool binary = text.starts_with("glTF");
  const std::size_t first = text.find_first_not_of(" \t\r\n\xef\xbb\xbf");
  if (!binary && (first == std::string_view::npos || text[first] != '{'))
    diagnostics.fail("is not a glTF file", "it begins with neither 'glTF' nor '{'");
  const Chunks chunks = binary ? splitBinary(bytes, diagnostics) : Chunks{text, {}};
  nlohmann::json root = checkJson(chunks.json, diagnostics);
  Document document;
  takeResources(root, chunks, folder, document, diagnostics);
  parse(root, document, diagnostics);
  expandMeshopt(document, diagnostics);
  expandDraco(document, diagnostics);
  expandInstances(document, diagnostics);
  return document;
}

// What `work` throws becomes an error with one line.
template <class Work>
Model guarded(Diagnostics& diagnostics, const Work& work) {
  try {
    return work();
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    diagnostics.fail("needs more memory than is available", "");
  } catch (const std::exception& error) {
    diagnostics.fail("cannot be read", error.what());
  }
}

Model load(std::span<const std::uint8_t> bytes, const std::filesystem::path& file, const GltfOptions& options,
           Diagnostics& diagnostics) {
  const Document document = readDocument(bytes, file.parent_path(), diagnostics);
  Model model = build(document, options, diagnostics);
  if (model.scene.name.empty()) model.scene.name = file.stem().string();
  return model;
}

}  // namespace

Model loadBytes(std::span<const std::uint8_t> bytes, const std::filesystem::path& file, const GltfOptions& options) {
  Diagnostics diagnostics;
  diagnostics.file = file.string();
  return guarded(diagnostics, [&] { return load(bytes, file, options, diagnostics); });
}

}  // namespace gltf

Model loadGltf(const std::filesystem::path& file, const GltfOptions& options) {
  gltf::Diagnostics diagnostics;
  diagnostics.file = file.string();
  return gltf::guarded(diagnostics,
                       [&] { return gltf::load(gltf::readFile(file, diagnostics), file, options, diagnostics); });
}

}  // namespace halfsilver
