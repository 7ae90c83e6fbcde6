#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <halfsilver/error.h>
#include <halfsilver/io.h>
#include "gltf_files.h"

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

}  // namespace halfsilver::testing
