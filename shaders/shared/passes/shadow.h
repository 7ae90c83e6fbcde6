// Bindings of the shadow pass: passes/shadow.*.
#ifndef HALFSILVER_PASSES_SHADOW_H
#define HALFSILVER_PASSES_SHADOW_H

#define SSBO_DRAW_LIST 9  // uint[triangles]: triangle numbers in drawing order

#endif
