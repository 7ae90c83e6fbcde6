// What a surface looks like at one point, as lighting needs it.

struct Surface {
  vec3 position;
  vec3 geometricNormal;  // faces the viewer
  vec3 normal;           // shading normal, faces the viewer
  vec3 baseColor;
  float alpha;  // of materials that blend; 1 of all others
  vec3 emissive;
  vec3 f0;  // reflectance at normal incidence
  float roughness;
  float metallic;
  float occlusion;
  float reflectivity;  // luminance of f0, faded by roughness; 0 for unlit
  bool unlit;
  // Of dielectrics, next to what f0 reflects.
  float transmission;  // share of what enters that passes through, 0..1; the rest is scattered back
  bool thin;           // a wall without an inside: rays pass without being bent or absorbed
  float ior;
  vec3 absorption;   // per meter inside
  float dispersion;  // 20 / Abbe number
  float thickness;   // meters, as the material says; rays measure it
  // A layer of index of refraction 1.5 on top of it all.
  float coat;  // share of the surface that has it, 0..1
  float coatRoughness;
  vec3 coatNormal;  // faces the viewer
#ifdef LOBES
  vec3 sheenColor;           // of the fibers below the coat
  float sheenRoughness;
  vec3 anisotropyDirection;  // along which the highlight is long: unit, in the plane of `normal`
  float anisotropy;          // 0..1
#endif
};

#ifdef LOBES
void leaveOutLobes(inout Surface s) {
  s.sheenColor = vec3(0.0);
  s.sheenRoughness = 1.0;
  s.anisotropyDirection = vec3(0.0);
  s.anisotropy = 0.0;
}
#endif

// For a surface whose transmission, coat and alpha nobody asks for.
void leaveOutLayers(inout Surface s) {
  s.alpha = 1.0;
  s.transmission = 0.0;
  s.thin = false;
  s.ior = 1.5;
  s.absorption = vec3(0.0);
  s.dispersion = 0.0;
  s.thickness = 0.0;
  s.coat = 0.0;
  s.coatRoughness = 0.0;
  s.coatNormal = s.normal;
#ifdef LOBES
  leaveOutLobes(s);
#endif
}

float luminance(vec3 color) { return dot(color, vec3(0.2126, 0.7152, 0.0722)); }
