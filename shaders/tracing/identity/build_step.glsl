// Which step of a build the program takes. In a block: some drivers compile a program anew for values of plain uniforms
// that decide branches, and the two steps would no longer be one program. BUILD_STEP is UBO_BUILD_STEP.
layout(std140, binding = BUILD_STEP) uniform BuildStepBlock {
  int secondStep;  // 0: entries are counted, 1: stored
  int ownAxis;     // 1: each triangle in its own dominant axis
};
