#pragma once

#include "io/gltf_document.h"

namespace halfsilver::gltf {

// The node hierarchy in rig order: parents before children, depth first, the scene's own nodes first.
struct Hierarchy {
  std::vector<halfsilver::Node> nodes;
  std::vector<int> fileNode;  // index in the file, for each of `nodes`
  std::vector<int> rigNode;   // index in `nodes`, for each of the file's nodes
  std::size_t inScene = 0;    // how many of `nodes` belong to the scene; they come first
};

// Throws through `diagnostics` for cycles, nodes with two parents and transforms that are not affine.
Hierarchy buildHierarchy(const Document& document, Diagnostics& diagnostics);

// Cameras and lights of the scene's nodes, with the nodes that carry them. follow() moves each to the rest pose.
void buildCameras(const Document& document, Diagnostics& diagnostics, const Hierarchy& hierarchy, Model& model);
void buildLights(const Document& document, Diagnostics& diagnostics, const Hierarchy& hierarchy, Model& model);

// The node's name, or "node 3".
std::string nodeName(const Document& document, int fileNode);

}  // namespace halfsilver::gltf
