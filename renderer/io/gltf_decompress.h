#pragma once

#include "io/gltf_document.h"

// Compressed geometry becomes plain buffers, views and accessors, so that nothing after it knows of compression.
namespace halfsilver::gltf {

// KHR_draco_mesh_compression: attributes and indices of primitives. Source: the extension's text; libdraco.
void expandDraco(Document& document, Diagnostics& diagnostics);

// EXT_meshopt_compression: buffer views. Source: the extension's text; meshoptimizer.
void expandMeshopt(Document& document, Diagnostics& diagnostics);

// EXT_mesh_gpu_instancing: a node with instances gets a child for each, which carries its mesh.
void expandInstances(Document& document, Diagnostics& diagnostics);

// A view of bytes that the file does not have as they are.
int addView(Document& document, std::vector<std::uint8_t> bytes, std::size_t stride);

}  // namespace halfsilver::gltf
