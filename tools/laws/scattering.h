#pragma once
// What a material scatters: a surface, its bsdf there, and the share of light that comes back.

#include "core/base/rng.h"
#include "law.h"
#include "mean.h"

namespace pbrt::laws {

// About the origin, facing +z, seen from above.
SurfaceInteraction flatSurface();

// The bsdf of a material at a point, with the memory it lives in.
class Scattering {
 public:
  // The material must outlive it.
  explicit Scattering(const Material& material, const SurfaceInteraction& at = flatSurface())
      : bsdf_(at) {
    material.scatter(at, bsdf_, scratch_);
  }
  explicit Scattering(std::shared_ptr<const Material> material,
                      const SurfaceInteraction& at = flatSurface())
      : Scattering(*material, at) {
    material_ = std::move(material);
  }
  explicit Scattering(const Subject& subject, const SurfaceInteraction& at = flatSurface())
      : Scattering(std::shared_ptr<const Material>(subject.make<Material>()), at) {}
  const Bsdf* operator->() const { return &bsdf_; }
  const Bsdf& operator*() const { return bsdf_; }

 private:
  std::shared_ptr<const Material> material_;  // lobes may refer to it
  Scratch scratch_;
  Bsdf bsdf_;
};

// In the x-z plane turned by phi about z; theta from z.
Vec3 direction(double degrees, double phi = 0.7);

// The share of light from wo that is scattered into the wanted lobes, by Monte Carlo over sample().
Mean albedo(const Bsdf& bsdf, const Vec3& wo, int samples, std::uint8_t wanted = kAllLobes);

std::span<const Law> materialSampleLaws();

}  // namespace pbrt::laws
