#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include <halfsilver/error.h>
#include <halfsilver/io.h>
#include "gltf_files.h"
#include "io/gltf_uri.h"

// What is loaded of the files that tests make.
namespace halfsilver::testing {

inline Model load(const GltfFile& file, const GltfOptions& options = {}) {
  const TemporaryFolder folder;
  return loadGltf(folder.write("scene.glb", file.glb()), options);
}

// Of a file that is refused as bad input; empty if it loads.
inline std::string problemOf(const GltfFile& file) {
  try {
    load(file);
    return "";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::badInput);
    return error.what();
  }
}

inline const Vertex& vertex(const Model& model, std::size_t triangle, std::size_t k) {
  return model.scene.vertices[model.scene.triangles.at(triangle).vertices[k]];
}
inline glm::vec3 corner(const Model& model, std::size_t triangle, std::size_t k) {
  return vertex(model, triangle, k).position;
}
inline bool near(const glm::vec3& a, const glm::vec3& b, float tolerance = 1e-5f) {
  return glm::distance(a, b) <= tolerance;
}

inline bool warns(const Model& model, const std::string& text) {
  return std::any_of(model.warnings.begin(), model.warnings.end(),
                     [&](const std::string& warning) { return warning.find(text) != std::string::npos; });
}

inline std::string textOf(const gltf::Resource& resource) { return {resource.bytes.begin(), resource.bytes.end()}; }

}  // namespace halfsilver::testing
