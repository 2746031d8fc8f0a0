#include "look.h"

namespace pbrt {

namespace {

constexpr std::size_t kTogether = 32;

using Numbers = float[kTogether];

float positivePart(float x) {
  return x > 0 ? x : 0;
}

}  // namespace

void shade(const Look& look, const PinholeCamera& camera, int x, int y,
           std::span<const surfels::Fragment> seen, float* const out[3]) {
  constexpr float kKey = 2.2F, kShine = 0.8F;
  // Over the beholder's left shoulder, whichever way they look.
  const Vec3 toKey = glm::normalize(-0.5F * camera.right() + camera.up() - 0.6F * camera.forward());
  const Vec3 up = camera.up(), first = camera.direction(x, y),
             step = camera.direction(x + 1, y) - first;
  // What comes from a direction: of the ground, and more of the sky as it rises.
  const Vec3 horizon = 0.5F * (look.ground + look.sky), more = 0.5F * (look.sky - look.ground);
  const Vec3 behind = look.background.value_or(horizon);
  const Vec3 moreBehind = look.background ? Vec3(0) : more;

  for (std::size_t begin = 0; begin < seen.size(); begin += kTogether) {
    const std::size_t count = std::min(kTogether, seen.size() - begin);
    Numbers met, nx, ny, nz;
    for (std::size_t i = 0; i < kTogether; ++i) {
      const surfels::Fragment& f = seen[begin + std::min(i, count - 1)];
      met[i] = f.t < kInfinity ? 1 : 0, nx[i] = f.n.x, ny[i] = f.n.y, nz[i] = f.n.z;
    }
    // How far the normal, the ray and its mirror image point upward; the light of key, highlight
    // and mirror.
    Numbers nUp, dUp, mirrorUp, key, shine, mirror;
    for (std::size_t i = 0; i < kTogether; ++i) {
      const Vec3 n(nx[i], ny[i], nz[i]);
      const Vec3 along = first + static_cast<float>(static_cast<int>(begin + i)) * step;
      const Vec3 d = along * (1 / std::sqrt(glm::dot(along, along)));
      const float cosine = positivePart(-glm::dot(n, d));
      nUp[i] = glm::dot(n, up);
      dUp[i] = glm::dot(d, up);
      mirrorUp[i] = dUp[i] + 2 * cosine * nUp[i];
      key[i] = kKey * positivePart(glm::dot(n, toKey));
      // Blinn: (n . h)^64.
      const Vec3 half = toKey - d;
      const float nHalf = positivePart(glm::dot(n, half)) / std::sqrt(glm::dot(half, half));
      const float power2 = nHalf * nHalf, power4 = power2 * power2, power8 = power4 * power4;
      const float power16 = power8 * power8, power32 = power16 * power16;
      shine[i] = kShine * power32 * power32;
      // Schlick: 0.02, as of water, and more at the rim.
      const float rest = 1 - cosine, rest2 = rest * rest;
      mirror[i] = 0.02F + 0.98F * rest2 * rest2 * rest;
    }
    for (int c = 0; c < 3; ++c) {
      const float color = look.color[c], level = horizon[c], rise = more[c];
      const float levelBehind = behind[c], riseBehind = moreBehind[c];
      Numbers light;
      for (std::size_t i = 0; i < kTogether; ++i) {
        // The half of the sky above n lights the skin evenly.
        const float body = color * (key[i] + level + nUp[i] * rise);
        const float reflected = level + mirrorUp[i] * rise;
        const float skin = (1 - mirror[i]) * body + mirror[i] * reflected + shine[i];
        light[i] = met[i] * skin + (1 - met[i]) * (levelBehind + dUp[i] * riseBehind);
      }
      std::copy_n(light, count, out[c] + begin);
    }
  }
}

}  // namespace pbrt
