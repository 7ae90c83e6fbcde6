#pragma once

#include "io/gltf_nodes.h"

namespace halfsilver::gltf {

// Fills the rig's skins, in the file's order.
void buildSkins(const Document& document, Diagnostics& diagnostics, const Hierarchy& hierarchy, Rig& rig);

// Fills the rig's animations, in the file's order; what cannot be played is skipped with a warning.
void buildAnimations(const Document& document, Diagnostics& diagnostics, const Hierarchy& hierarchy, Rig& rig);

// For each node whether any animation moves it, directly or through an ancestor.
std::vector<std::uint8_t> movingNodes(const Rig& rig);

// Whether an animation moves the instance: its node, its joints or its morph weights.
bool canMove(const Rig& rig, const std::vector<std::uint8_t>& moving, const Instance& instance);

}  // namespace halfsilver::gltf
