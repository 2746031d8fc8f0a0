#pragma once
// What the tests of materials share: a surface, its bsdf, and what it reflects.

#include "core/base/rng.h"
#include "core/base/warp.h"
#include "tests/support.h"

namespace pbrt::test {

inline SurfaceInteraction flatSurface() {
  SurfaceInteraction at;
  at.n = at.ns = {0, 0, 1};
  at.tangent = at.dpdu = {1, 0, 0};
  at.dpdv = {0, 1, 0};
  at.wo = {0, 0, 1};
  return at;
}

// The bsdf of a material at a point, with the memory it lives in.
class Scattering {
 public:
  explicit Scattering(const Material& material, const SurfaceInteraction& at = flatSurface())
      : bsdf_(at) {
    material.scatter(at, bsdf_, scratch_);
  }
  explicit Scattering(const std::string& name, const ParamList& list = {})
      : Scattering(std::shared_ptr<const Material>(make<Material>(name, list))) {}
  const Bsdf* operator->() const { return &bsdf_; }

 private:
  explicit Scattering(std::shared_ptr<const Material> material) : Scattering(*material) {
    material_ = std::move(material);
  }

  std::shared_ptr<const Material> material_;  // lobes may refer to it
  Scratch scratch_;
  Bsdf bsdf_;
};

inline Vec3 direction(double degrees, double phi = 0.7) {
  const double theta = degrees * std::numbers::pi / 180;
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

// Of estimates of one number.
struct Moments {
  int n = 0;
  double mean = 0, squares = 0;  // of the deviations from the mean

  void add(double x) {
    const double before = x - mean;
    mean += before / ++n;
    squares += before * (x - mean);
  }
  double variance() const { return squares / (n - 1); }
  double error() const { return std::sqrt(variance() / n); }  // of the mean
};

// The share of light from wo that is scattered into the wanted lobes, by Monte Carlo over sample().
inline double albedo(const Bsdf& bsdf, const Vec3& wo, int samples,
                     std::uint8_t wanted = kAllLobes) {
  Rng rng(1);
  double sum = 0;
  for (int i = 0; i < samples; ++i) {
    const Point2 u{rng.uniform(), rng.uniform()};
    if (const auto s = bsdf.sample(wo, u, wanted))
      sum += s->f.y * std::abs(s->wi.z) / s->pdf * (s->flags & kTransmission ? sqr(s->eta) : 1);
  }
  return sum / samples;
}

}  // namespace pbrt::test
