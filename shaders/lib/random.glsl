// Numbers that look random and repeat to the bit: Sobol's (0, 2)-sequence, scrambled and shuffled by hashes after Owen
// (Burley 2020, "Practical Hash-based Owen Scrambling"). Every beginning of a pixel's sequence is spread evenly.

// A hash of 32 bits in which every bit of the input reaches every bit (the finalizer lowbias32 of Wellons 2018).
uint hashed(uint x) {
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  return x ^ (x >> 16);
}

uint joined(uint seed, uint value) { return hashed(seed ^ (value + 0x9e3779b9u + (seed << 6) + (seed >> 2))); }

// Owen's scrambling of a number whose bits are in reverse order: only lower bits decide whether one is flipped
// (the constants are Vegdahl's, 2021).
uint scrambledReversed(uint x, uint seed) {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return x;
}

uint scrambled(uint x, uint seed) { return bitfieldReverse(scrambledReversed(bitfieldReverse(x), seed)); }

float unitFloat(uint bits) { return float(bits >> 8) * (1.0 / 16777216.0); }  // 0 <= x < 1

// Number `index` of the sequence for a purpose, of which every choice that a path makes has its own.
vec2 sample2(uint pixel, uint index, uint purpose) {
  uint seed = joined(hashed(pixel), purpose);
  uint shuffled = scrambled(index, seed);
  // Bit i of the second number, in reverse order, is the sum of all bits j that hold i: Pascal's triangle modulo 2.
  uint second = shuffled;
  second ^= (second >> 1) & 0x55555555u;
  second ^= (second >> 2) & 0x33333333u;
  second ^= (second >> 4) & 0x0f0f0f0fu;
  second ^= (second >> 8) & 0x00ff00ffu;
  second ^= second >> 16;
  uint x = bitfieldReverse(scrambledReversed(shuffled, joined(seed, 1u)));
  uint y = bitfieldReverse(scrambledReversed(second, joined(seed, 2u)));
  return vec2(unitFloat(x), unitFloat(y));
}
