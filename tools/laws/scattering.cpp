#include "scattering.h"

namespace pbrt::laws {

SurfaceInteraction flatSurface() {
  SurfaceInteraction at;
  at.n = at.ns = {0, 0, 1};
  at.tangent = at.dpdu = {1, 0, 0};
  at.dpdv = {0, 1, 0};
  at.wo = {0, 0, 1};
  return at;
}

Vec3 direction(double degrees, double phi) {
  const double theta = degrees * std::numbers::pi / 180;
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

Mean albedo(const Bsdf& bsdf, const Vec3& wo, int samples, std::uint8_t wanted) {
  Mean share;
  Rng rng(1);
  for (int i = 0; i < samples; ++i) {
    const Point2 u{rng.uniform(), rng.uniform()};
    const auto s = bsdf.sample(wo, u, wanted);
    // Radiance is denser by the square of the index in the denser medium; power is not.
    share.add(s ? s->f.y * std::abs(s->wi.z) * sqr(s->eta) / s->pdf : 0);
  }
  return share;
}

}  // namespace pbrt::laws
