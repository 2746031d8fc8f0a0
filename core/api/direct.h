#pragma once
// Light that comes straight from the lights.

#include <array>

#include "core/api/integrator.h"

namespace pbrt {

// The ray that decides whether a light sample reaches the point.
inline Ray shadowRay(const SurfaceInteraction& at, const LightSample& light) {
  return light.finite ? spawnRayTo(at, light.p, light.error, light.n) : spawnRay(at, light.wi);
}

// The weight of a sample of a strategy that takes n samples of density a > 0, where the other one
// takes m of density b (Veach 1997, section 9.2.4, power heuristic with exponent 2). For a strategy
// that is used with some chance only, n is that chance.
inline float powerHeuristic(float n, float a, float m, float b) {
  const float r = m * b / (n * a);
  return 1 / (1 + r * r);
}

// f L |cos theta| / pdf: the radiance that leaves `at` towards at.wo for a sample of a light whose
// shadowRay() nothing blocks. Black: the ray need not be traced. The sample is one of n, weighted
// against m that the lobes `lobes` of the BSDF take; m = 0: no other strategy finds the light.
inline Spectrum unshadowed(const SurfaceInteraction& at, const Bsdf& bsdf, const LightSample& light,
                           float n, float m, std::uint8_t lobes) {
  if (light.pdf == 0 || isBlack(light.L)) return Spectrum(0);
  const Spectrum f = bsdf.f(at.wo, light.wi);
  if (isBlack(f)) return Spectrum(0);
  const float weight =
      m == 0 ? 1 : powerHeuristic(n, light.pdf, m, bsdf.pdf(at.wo, light.wi, lobes));
  return f * light.L * (std::abs(glm::dot(light.wi, at.ns)) * weight / light.pdf);
}

// Gathers contributions that each wait for a shadow ray, and traces the rays in packets. Rays from
// one point to one light are alike, which is what packets need.
class ShadowedSum {
 public:
  explicit ShadowedSum(const World& world) : world_(world) {}  // NOLINT: see rays_

  void add(const Ray& ray, const Spectrum& contribution) {
    if (count_ == World::kBatch) trace();
    rays_[count_] = ray;
    contributions_[count_++] = contribution;
  }

  // The sum of all contributions whose ray is not blocked, dimmed by the regions.
  Spectrum sum() {
    trace();
    return sum_;
  }

 private:
  void trace() {
    if (count_ == 0) return;
    const std::uint32_t blocked =
        world_.occluded(std::span<const Ray>(rays_.data(), static_cast<std::size_t>(count_)));
    for (int i = 0; i < count_; ++i)
      if (!(blocked >> i & 1U)) sum_ += dimmed(contributions_[i], world_, rays_[i], rays_[i].tMax);
    count_ = 0;
  }

  const World& world_;
  int count_ = 0;
  Spectrum sum_{0};
  // Deliberately without initial values: most points use few of them.
  union {
    std::array<Ray, World::kBatch> rays_;
  };
  std::array<Spectrum, World::kBatch> contributions_;
};

}  // namespace pbrt
