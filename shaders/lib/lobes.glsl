// Sheen and stretched highlights, KHR_materials_sheen and KHR_materials_anisotropy: only in programs of scenes that have
// them (LOBES).
//
// Sheen is a layer of fibers: the distribution of Estevez & Kulla 2017 with the visibility of Neubelt & Pettineo 2013.
// What lies below gets what the fibers leave, by their albedo seen from the viewer and from the light, the less of both.
#ifdef LOBES

// Narrower lobes would give back more than arrives at most angles.
const float NARROWEST_SHEEN = 0.2;

// Integral of the lobe of white fibers, seen at a cosine: a fit, within 0.02. More than 1 at grazing angles below a
// roughness of 0.4.
float sheenIntegral(float cosine, float roughness) {
  float inverse = 1.0 / max(roughness, NARROWEST_SHEEN);
  vec4 terms = vec4(-0.93029, -0.70545, 0.41819, 0.064901) + inverse * (vec4(0.47544, -1.5242, 1.6375, -1.0703) +
               inverse * vec4(-0.031267, -0.004602, 0.040885, -0.34676));
  return exp(terms.x + cosine * (terms.y + cosine * (terms.z + cosine * terms.w)));
}

// Reflected of all that arrives, by white fibers towards a cosine.
float sheenAlbedo(float cosine, float roughness) { return min(sheenIntegral(cosine, roughness), 1.0); }

// What the fibers leave to what is below them.
float belowSheen(vec3 color, float roughness, float cosine) {
  return 1.0 - min(max(color.r, max(color.g, color.b)) * sheenAlbedo(cosine, roughness), 1.0);
}

// Reflected radiance of white fibers for unit irradiance, without the light's cosine. No more than arrives.
float sheenLobe(float nh, float nv, float nl, float roughness) {
  float wide = max(roughness, NARROWEST_SHEEN), inverse = 1.0 / (wide * wide);
  float distribution = (2.0 + inverse) * pow(max(1.0 - nh * nh, 0.0), 0.5 * inverse) / 6.28318530717959;
  return distribution / (4.0 * (nl + nv - nl * nv) * max(sheenIntegral(nv, roughness), 1.0));
}

// The two roughnesses of a highlight that is stretched (Burley 2012): along the direction of anisotropy and across it.
vec2 stretchedAlphas(float alpha, float anisotropy) {
  return vec2(mix(alpha, 1.0, anisotropy * anisotropy), alpha);
}

#endif
