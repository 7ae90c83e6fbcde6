// The ordered dither of 256 x 256 pixels (Bayer 1973): every value occurs once in a tile and the pixels below any value
// are spread evenly.
float scatteredThreshold(uvec2 pixel) {
  uint rank = 0u;
  for (uint bit = 0u; bit < 8u; ++bit) {
    uint x = (pixel.x >> bit) & 1u, y = (pixel.y >> bit) & 1u;
    rank |= ((x ^ y) << 1u | y) << (2u * (7u - bit));
  }
  return (float(rank) + 0.5) / 65536.0;
}
