#pragma once

#include <halfsilver/model.h>

namespace halfsilver {

// Throws Error (usage), saying what and where, if an index of the model's rig points nowhere or lists that belong
// together differ in length: what evaluate() and poses rely on. Triangles are those of Scene and not looked at.
void checkRig(const Model& model);

}  // namespace halfsilver
