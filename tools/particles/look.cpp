#include "look.h"

namespace pbrt {

namespace {

constexpr std::size_t kTogether = 32;

using Numbers = float[kTogether];

float positivePart(float x) {
  return x > 0 ? x : 0;
}

}  // namespace

// The key light shines over the beholder's left shoulder, whichever way they look.
Shader::Shader(const Look& look, const PinholeCamera& camera)
    : camera_(camera),
      toKey_(glm::normalize(-0.5F * camera.right() + camera.up() - 0.6F * camera.forward())),
      color_(look.color),
      horizon_(0.5F * (look.ground + look.sky)),
      rise_(0.5F * (look.sky - look.ground)),
      horizonBehind_(look.background.value_or(horizon_)),
      riseBehind_(look.background ? Vec3(0) : rise_) {}

void Shader::shade(int x, int y, std::span<const surfels::Fragment> seen,
                   float* const out[3]) const {
  constexpr float kKey = 2.2F, kShine = 0.8F;
  const Vec3 first = camera_.direction(x, y), step = camera_.stepRight(), up = camera_.up();
  const Vec3 toKey = toKey_;
  for (std::size_t begin = 0; begin < seen.size(); begin += kTogether) {
    const std::size_t count = std::min(kTogether, seen.size() - begin);
    Numbers met, nx, ny, nz;
    bool any = false;
    for (std::size_t i = 0; i < kTogether; ++i) {
      const surfels::Fragment& f = seen[begin + std::min(i, count - 1)];
      const bool here = f.t < kInfinity;
      any |= here;
      met[i] = here ? 1 : 0, nx[i] = f.n.x, ny[i] = f.n.y, nz[i] = f.n.z;
    }
    Numbers dx, dy, dz, dUp;
    for (std::size_t i = 0; i < kTogether; ++i) {
      const Vec3 along = first + static_cast<float>(static_cast<int>(begin + i)) * step;
      const Vec3 d = along * (1 / std::sqrt(glm::dot(along, along)));
      dx[i] = d.x, dy[i] = d.y, dz[i] = d.z, dUp[i] = glm::dot(d, up);
    }
    Numbers light[3];
    for (int c = 0; c < 3; ++c) {
      const float level = horizonBehind_[c], rise = riseBehind_[c];
      for (std::size_t i = 0; i < kTogether; ++i) light[c][i] = level + dUp[i] * rise;
    }
    if (any) {
      // How far the normal, the ray and its mirror image point upward; the light of key, highlight
      // and mirror.
      Numbers nUp, mirrorUp, key, shine, mirror;
      for (std::size_t i = 0; i < kTogether; ++i) {
        const Vec3 n(nx[i], ny[i], nz[i]), d(dx[i], dy[i], dz[i]);
        const float cosine = positivePart(-glm::dot(n, d));
        nUp[i] = glm::dot(n, up);
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
        const float color = color_[c], level = horizon_[c], rise = rise_[c];
        for (std::size_t i = 0; i < kTogether; ++i) {
          // The half of the sky above n lights the skin evenly.
          const float body = color * (key[i] + level + nUp[i] * rise);
          const float reflected = level + mirrorUp[i] * rise;
          const float skin = (1 - mirror[i]) * body + mirror[i] * reflected + shine[i];
          light[c][i] = met[i] * skin + (1 - met[i]) * light[c][i];
        }
      }
    }
    for (int c = 0; c < 3; ++c) std::copy_n(light[c], count, out[c] + begin);
  }
}

}  // namespace pbrt
