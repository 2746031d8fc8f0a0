#include "core/base/noise.h"

#include <array>
#include <cstdint>

namespace pbrt {

namespace {

// Perlin's permutation of 0 to 255.
constexpr std::array<std::uint8_t, 256> kPermutation = {
    151, 160, 137, 91,  90,  15,  131, 13,  201, 95,  96,  53,  194, 233, 7,   225, 140, 36,  103,
    30,  69,  142, 8,   99,  37,  240, 21,  10,  23,  190, 6,   148, 247, 120, 234, 75,  0,   26,
    197, 62,  94,  252, 219, 203, 117, 35,  11,  32,  57,  177, 33,  88,  237, 149, 56,  87,  174,
    20,  125, 136, 171, 168, 68,  175, 74,  165, 71,  134, 139, 48,  27,  166, 77,  146, 158, 231,
    83,  111, 229, 122, 60,  211, 133, 230, 220, 105, 92,  41,  55,  46,  245, 40,  244, 102, 143,
    54,  65,  25,  63,  161, 1,   216, 80,  73,  209, 76,  132, 187, 208, 89,  18,  169, 200, 196,
    135, 130, 116, 188, 159, 86,  164, 100, 109, 198, 173, 186, 3,   64,  52,  217, 226, 250, 124,
    123, 5,   202, 38,  147, 118, 126, 255, 82,  85,  212, 207, 206, 59,  227, 47,  16,  58,  17,
    182, 189, 28,  42,  223, 183, 170, 213, 119, 248, 152, 2,   44,  154, 163, 70,  221, 153, 101,
    155, 167, 43,  172, 9,   129, 22,  39,  253, 19,  98,  108, 110, 79,  113, 224, 232, 178, 185,
    112, 104, 218, 246, 97,  228, 251, 34,  242, 193, 238, 210, 144, 12,  191, 179, 162, 241, 81,
    51,  145, 235, 249, 14,  239, 107, 49,  192, 214, 31,  181, 199, 106, 157, 184, 84,  204, 176,
    115, 121, 50,  45,  127, 4,   150, 254, 138, 236, 205, 93,  222, 114, 67,  29,  24,  72,  243,
    141, 128, 195, 78,  66,  215, 61,  156, 180};

unsigned permuted(unsigned i) {
  return kPermutation[i & 255U];
}

// The scalar product of (x, y, z), from a corner of the lattice, with its gradient: one of the
// twelve to the middle of a cube's edges, four of them twice. Which ones are the twice, and in
// which order, is pbrt's choice, not Perlin's.
float gradient(unsigned hash, float x, float y, float z) {
  const unsigned h = hash & 15U;
  const float u = h < 8 || h == 12 || h == 13 ? x : y;
  const float v = h < 4 || h == 12 || h == 13 ? y : z;
  return ((h & 1U) ? -u : u) + ((h & 2U) ? -v : v);
}

// 6 t^5 - 15 t^4 + 10 t^3: from 0 to 1, with two derivatives that vanish at both ends.
float fade(float t) {
  return t * t * t * (t * (t * 6 - 15) + 10);
}

float smoothStep(float x, float from, float to) {
  const float t = std::clamp((x - from) / (to - from), 0.F, 1.F);
  return t * t * (3 - 2 * t);
}

// Calls sum(weight, noise) for all octaves that a pixel can show, and last for the one that is
// fading, with how much of it is there. Noise of wavelength 1 needs two samples a wave (Nyquist):
// octave i has the wavelength 2^-i, and the footprint sqrt(len2), so that i < -1 - log2(len2) / 2.
// Returns the weight of the octave after the fading one and its number.
struct Rest {
  float weight;
  int octave;
};
template <class Sum, class Fading>
Rest octavesOf(const DPoint3& p, const DVec3& dx, const DVec3& dy, float roughness, int octaves,
               const Sum& sum, const Fading& fading) {
  const double len2 = std::max(lengthSquared(dx), lengthSquared(dy));
  const double n =
      len2 > 0 ? std::clamp(-1 - 0.5 * std::log2(len2), 0.0, double(octaves)) : octaves;
  const int whole = static_cast<int>(n);
  double scale = 1;
  float weight = 1;
  for (int i = 0; i < whole; ++i) {
    sum(weight, noise(scale * p));
    scale *= 1.99;
    weight *= roughness;
  }
  fading(weight, smoothStep(static_cast<float>(n - whole), 0.3F, 0.7F), noise(scale * p));
  return {weight, whole};
}

}  // namespace

float noise(const DPoint3& p) {
  const DPoint3 corner = glm::floor(p);
  const Vec3 d(p - corner);
  // Modulo 256 in double: the corner may be beyond every integer.
  const DPoint3 cell = corner - 256.0 * glm::floor(corner / 256.0);
  const auto x = static_cast<unsigned>(cell.x), y = static_cast<unsigned>(cell.y);
  const auto z = static_cast<unsigned>(cell.z);
  const auto at = [&](unsigned i, unsigned j, unsigned k) {
    return gradient(permuted(permuted(permuted(x + i) + y + j) + z + k),
                    d.x - static_cast<float>(i), d.y - static_cast<float>(j),
                    d.z - static_cast<float>(k));
  };
  const Vec3 t(fade(d.x), fade(d.y), fade(d.z));
  const auto alongX = [&](unsigned j, unsigned k) { return lerp(t.x, at(0, j, k), at(1, j, k)); };
  return lerp(t.z, lerp(t.y, alongX(0, 0), alongX(1, 0)), lerp(t.y, alongX(0, 1), alongX(1, 1)));
}

float fbm(const DPoint3& p, const DVec3& dx, const DVec3& dy, float roughness, int octaves) {
  float sum = 0;
  octavesOf(
      p, dx, dy, roughness, octaves, [&](float weight, float n) { sum += weight * n; },
      [&](float weight, float share, float n) { sum += weight * share * n; });
  return sum;
}

// The mean of |noise| is about 0.2: what is faded out is replaced by it.
float turbulence(const DPoint3& p, const DVec3& dx, const DVec3& dy, float roughness, int octaves) {
  constexpr float mean = 0.2F;
  float sum = 0;
  Rest rest = octavesOf(
      p, dx, dy, roughness, octaves, [&](float weight, float n) { sum += weight * std::abs(n); },
      [&](float weight, float share, float n) { sum += weight * lerp(share, mean, std::abs(n)); });
  for (; rest.octave < octaves; ++rest.octave) {
    sum += mean * rest.weight;
    rest.weight *= roughness;
  }
  return sum;
}

}  // namespace pbrt
