#pragma once
// What lies under a clear coat.

#include <array>
#include <memory>

#include "core/api/lobes_microfacet.h"

namespace pbrt {

// The outer boundary of a coat, at one point of it: the share of light that it lets through. Light
// that comes in from w and light that leaves towards w share it, for Fresnel's equations are
// reciprocal.
class CoatBoundary {
 public:
  // Smooth: the coat's index of refraction over that outside is eta.
  explicit CoatBoundary(float eta) : eta_(eta), inside_(fresnelDiffuse(1 / eta)) {}

  float eta() const { return eta_; }
  float transmittance(float cosTheta) const {
    return row_ ? tabulated(std::abs(cosTheta)) : 1 - fresnelDielectric(std::abs(cosTheta), eta_);
  }
  // The share of diffuse light from below that is sent back.
  float insideReflectance() const { return inside_; }

 private:
  friend class RoughCoatTable;
  static constexpr int kCosines = 17;  // at (j / 16)^2, as transmittance drops near the horizon
  using Row = std::array<float, kCosines>;

  float tabulated(float cosTheta) const;

  float eta_ = 1, inside_ = 0;
  const Row* row_ = nullptr;  // null: smooth
  float next_ = 0;            // share of the row that follows
};

// Rough boundaries with one index of refraction. Light is scattered at most once on its way
// through; what its facets mask is lost.
class RoughCoatTable {
 public:
  explicit RoughCoatTable(float eta);
  // The table for eta, which all who ask for it share as long as one of them lives: to fill it
  // takes milliseconds, and most coats of a scene have the same.
  static std::shared_ptr<const RoughCoatTable> shared(float eta);

  // With facets of the width alpha (for two widths their geometric mean); 0 is smooth. It refers to
  // this table, which must outlive it.
  CoatBoundary boundary(float alpha) const;

 private:
  static constexpr int kWidths = 9;  // alpha = i / 8; wider ones are taken as 1

  CoatBoundary smooth_;
  std::array<CoatBoundary::Row, kWidths> transmittance_;
  std::array<float, kWidths> inside_;
};

// A diffuse surface under the coat. Light gets through the coat, and of what the base reflects the
// coat sends the share F_i back to it, again and again:
//   f = T(o) T(i) r / (pi eta^2) (1 + r F_i + (r F_i)^2 + ...)
// (radiance is denser by eta^2 inside). A white base under a smooth coat loses nothing, as
// fresnelDiffuse() is reciprocal.
class CoatedDiffuse final : public Bxdf {
 public:
  CoatedDiffuse(const Spectrum& reflectance, const CoatBoundary& coat)
      : Bxdf(kReflection | kDiffuse),
        base_(reflectance * kInvPi /
              (sqr(coat.eta()) * (1.F - coat.insideReflectance() * reflectance))),
        coat_(coat) {}
  Spectrum f(const Vec3& wo, const Vec3& wi) const override {
    if (!sameHemisphere(wo, wi)) return Spectrum(0);
    return base_ * (coat_.transmittance(wo.z) * coat_.transmittance(wi.z));
  }
  float weight(const Vec3& wo) const override {
    return kPi * luminance(base_) * coat_.transmittance(wo.z);
  }

 private:
  Spectrum base_;
  CoatBoundary coat_;
};

// A rough conductor under the coat. Refraction by the coat spreads its highlight: seen frontally,
// as facets that are steeper by eta would. Such facets are taken for every direction, with the
// conductor's Fresnel term C at the angle inside, and the transmittance of the coat both ways. Of
// what the conductor sends up the coat sends a share F back to it, again and again. As if all this
// went the same way,
//   f = f'(o, i) T(o) T(i) (1 + F C + (F C)^2 + ...),
// with the lesser F of both directions, so that no energy is made. Exact for smooth layers.
class CoatedConductor final : public Bxdf {
 public:
  // `alphaX`, `alphaY`: the conductor's; `conductor`: its index over that of the coat.
  CoatedConductor(const CoatBoundary& coat, float alphaX, float alphaY,
                  const ConductorFresnel& conductor)
      : Bxdf(kReflection | kGlossy),
        coat_(coat),
        facets_(Spectrum(1), {coat.eta() * alphaX, coat.eta() * alphaY}, {}),
        conductor_(conductor) {}
  Spectrum f(const Vec3& wo, const Vec3& wi) const override {
    return sameHemisphere(wo, wi) ? facets_.f(wo, wi) * filtered(wo, wi) : Spectrum(0);
  }
  float pdf(const Vec3& wo, const Vec3& wi) const override { return facets_.pdf(wo, wi); }
  std::optional<BsdfSample> sample(const Vec3& wo, Point2 u) const override {
    std::optional<BsdfSample> s = facets_.sample(wo, u);
    if (s) s->f *= filtered(wo, s->wi);
    return s;
  }
  float weight(const Vec3& wo) const override {
    return sqr(coat_.transmittance(wo.z)) * luminance(conductor_(1));
  }

 private:
  // The share that coat and conductor leave of the light that the facets turn from wi to wo.
  Spectrum filtered(const Vec3& wo, const Vec3& wi) const;

  CoatBoundary coat_;
  MicrofacetReflection<TrowbridgeReitz, NoFresnel> facets_;
  ConductorFresnel conductor_;
};

// A mirror under a smooth coat of index eta, with all reflections between the two:
// R = F + T^2 C (1 + F C + (F C)^2 + ...), where C is the conductor's Fresnel term.
struct CoatedConductorFresnel {
  float eta = 1;
  ConductorFresnel conductor;  // its index over that of the coat
  Spectrum operator()(float cosTheta) const;
};

}  // namespace pbrt
