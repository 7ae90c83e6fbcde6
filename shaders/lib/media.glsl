// The media that a ray is in (ScatteredPath::media): material + 1 of two volumes, 16 bits each, the last one entered in
// the lower half; 0 is air.
//
// Where volumes lie in one another or overlap, the last one entered fills the place. Entering puts a material on top,
// so that a third one displaces the outermost; leaving takes that material out, wherever it stands. Only a border at
// which the topmost changes bends and reflects.
#include "lib/scene.glsl"

const uint MEDIA_MATERIALS = 0xffffu;  // of higher numbers are thin

bool inMedium(uint media, uint material) {
  return (media & 0xffffu) == material + 1u || media >> 16 == material + 1u;
}

uint enterMedium(uint media, uint material) { return media << 16 | (material + 1u); }

uint leaveMedium(uint media, uint material) {
  if ((media & 0xffffu) == material + 1u) return media >> 16;
  return media >> 16 == material + 1u ? media & 0xffffu : media;
}

// By color: red, green and blue bend differently if the material disperses light (KHR_materials_dispersion); 1, green,
// is in the middle.
float indexOf(float ior, float dispersion, int color) {
  return max(ior + float(color - 1) * (ior - 1.0) * 0.025 * dispersion, 1.0);
}

float indexOfMedium(uint media, int color) {
  uint top = media & 0xffffu;
  return top == 0u ? 1.0 : indexOf(materials[top - 1u].ior, materials[top - 1u].dispersion, color);
}

// What is left of light after a way through it (Beer's law).
vec3 throughMedium(uint media, float distance) {
  uint top = media & 0xffffu;
  return top == 0u ? vec3(1.0) : exp(-distance * materials[top - 1u].absorption);
}
