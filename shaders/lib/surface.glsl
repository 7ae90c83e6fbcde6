// What a surface looks like at one point, as lighting needs it.

struct Surface {
  vec3 position;
  vec3 geometricNormal;  // faces the viewer
  vec3 normal;           // shading normal, faces the viewer
  vec3 baseColor;
  vec3 emissive;
  vec3 f0;  // reflectance at normal incidence
  float roughness;
  float metallic;
  float occlusion;
  float reflectivity;  // luminance of f0, faded by roughness; 0 for unlit
  bool unlit;
};

float luminance(vec3 color) { return dot(color, vec3(0.2126, 0.7152, 0.0722)); }
