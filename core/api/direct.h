#pragma once
// Light that comes straight from the lights.

#include <array>

#include "core/api/world.h"

namespace pbrt {

// The ray that decides whether a light sample reaches the point.
inline Ray shadowRay(const SurfaceInteraction& at, const LightSample& light) {
  return light.finite ? spawnRayTo(at, light.p, light.error, light.n) : spawnRay(at, light.wi);
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

  // The sum of all contributions whose ray is not blocked.
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
      if (!(blocked >> i & 1U)) sum_ += contributions_[i];
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
