#pragma once
// The lobes that materials are made of. Reflectances are >= 0; above 1 they create energy.

#include "core/api/bsdf.h"
#include "core/base/fresnel.h"
#include "core/base/microfacet.h"

namespace pbrt {

// Directions closer to the surface than this do not scatter: the model's values, which grow with
// 1 / cos, stay finite.
inline constexpr float kMinCosine = 1e-6F;

// Equal radiance into all directions.
class Lambertian final : public Bxdf {
 public:
  explicit Lambertian(const Spectrum& reflectance)
      : Bxdf(kReflection | kDiffuse), f_(reflectance * kInvPi) {}
  Spectrum f(const Vec3& wo, const Vec3& wi) const override;
  float weight(const Vec3&) const override { return kPi * luminance(f_); }

 private:
  Spectrum f_;
};

// Rough diffuse surfaces: Lambertian facets whose slope angles have the standard deviation sigma
// (radians), in the qualitative model of Oren and Nayar 1994, equation 30.
class OrenNayar final : public Bxdf {
 public:
  OrenNayar(const Spectrum& reflectance, float sigma);
  Spectrum f(const Vec3& wo, const Vec3& wi) const override;
  float weight(const Vec3&) const override { return kPi * luminance(f_); }

 private:
  Spectrum f_;
  float a_, b_;
};

// A mirror; the Fresnel term is a value of core/base/fresnel.h.
template <class Fresnel>
class SpecularReflection final : public Bxdf {
 public:
  SpecularReflection(const Spectrum& reflectance, const Fresnel& fresnel)
      : Bxdf(kReflection | kSpecular), reflectance_(reflectance), fresnel_(fresnel) {}
  Spectrum f(const Vec3&, const Vec3&) const override { return Spectrum(0); }
  float pdf(const Vec3&, const Vec3&) const override { return 0; }
  std::optional<BsdfSample> sample(const Vec3& wo, Point2) const override {
    if (absCosTheta(wo) < kMinCosine) return {};
    return BsdfSample{fresnel_(wo.z) * reflectance_ / absCosTheta(wo), {-wo.x, -wo.y, wo.z}, 1};
  }
  float weight(const Vec3& wo) const override { return luminance(fresnel_(wo.z) * reflectance_); }

 private:
  Spectrum reflectance_;
  Fresnel fresnel_;
};

// Refraction into a medium whose index over the outer one is eta (z points outward). Radiance is
// scaled by the square of the ratio of indices, as it is denser in the denser medium.
class SpecularTransmission final : public Bxdf {
 public:
  SpecularTransmission(const Spectrum& transmittance, float eta)
      : Bxdf(kTransmission | kSpecular), transmittance_(transmittance), eta_(eta) {}
  Spectrum f(const Vec3& wo, const Vec3& wi) const override;
  float pdf(const Vec3& wo, const Vec3& wi) const override;
  std::optional<BsdfSample> sample(const Vec3& wo, Point2 u) const override;
  float weight(const Vec3& wo) const override {
    return (1 - fresnelDielectric(wo.z, eta_)) * luminance(transmittance_);
  }

 private:
  Spectrum transmittance_;
  float eta_;
};

// Light that goes straight on: of a pane, or where part of a surface is missing. What the Fresnel
// term does not reflect is let through.
template <class Fresnel>
class StraightTransmission final : public Bxdf {
 public:
  StraightTransmission(const Spectrum& transmittance, const Fresnel& fresnel)
      : Bxdf(kTransmission | kSpecular), transmittance_(transmittance), fresnel_(fresnel) {}
  Spectrum f(const Vec3&, const Vec3&) const override { return Spectrum(0); }
  float pdf(const Vec3&, const Vec3&) const override { return 0; }
  std::optional<BsdfSample> sample(const Vec3& wo, Point2) const override {
    if (absCosTheta(wo) < kMinCosine) return {};
    return BsdfSample{(1 - fresnel_(wo.z)) * transmittance_ / absCosTheta(wo), -wo, 1};
  }
  float weight(const Vec3& wo) const override {
    return (1 - fresnel_(wo.z)) * luminance(transmittance_);
  }

 private:
  Spectrum transmittance_;
  Fresnel fresnel_;
};

// What the lobe reflects, let through instead: mirrored at the surface.
template <class Lobe>
class Through final : public Bxdf {
 public:
  explicit Through(const Lobe& lobe)
      : Bxdf(lobe.flags() ^ (kReflection | kTransmission)), lobe_(lobe) {}
  Spectrum f(const Vec3& wo, const Vec3& wi) const override { return lobe_.f(wo, mirrored(wi)); }
  float pdf(const Vec3& wo, const Vec3& wi) const override { return lobe_.pdf(wo, mirrored(wi)); }
  std::optional<BsdfSample> sample(const Vec3& wo, Point2 u) const override {
    std::optional<BsdfSample> s = lobe_.sample(wo, u);
    if (s) s->wi = mirrored(s->wi);
    return s;
  }
  float weight(const Vec3& wo) const override { return lobe_.weight(wo); }

 private:
  static Vec3 mirrored(const Vec3& w) { return {w.x, w.y, -w.z}; }
  Lobe lobe_;
};

// The facet normal that mirrors one direction into the other, and its cosine with them, which for
// unit directions is |wo + wi| / 2; zero if there is none.
inline float halfVector(const Vec3& wo, const Vec3& wi, Vec3& h) {
  h = wo + wi;
  const float length = std::sqrt(lengthSquared(h));
  if (!(length > 0) || std::min(absCosTheta(wo), absCosTheta(wi)) < kMinCosine) return 0;
  h /= length;
  return 0.5F * length;
}

// Small mirrors (Torrance and Sparrow 1967) with normals by a distribution of
// core/base/microfacet.h.
template <class Distribution, class Fresnel>
class MicrofacetReflection final : public Bxdf {
 public:
  MicrofacetReflection(const Spectrum& reflectance, const Distribution& distribution,
                       const Fresnel& fresnel)
      : Bxdf(kReflection | kGlossy),
        reflectance_(reflectance),
        distribution_(distribution),
        fresnel_(fresnel) {}

  Spectrum f(const Vec3& wo, const Vec3& wi) const override {
    Vec3 h;
    const float cosH = halfVector(wo, wi, h);
    return cosH > 0 ? value(wo, wi, h, cosH, distribution_.D(h)) : Spectrum(0);
  }
  float pdf(const Vec3& wo, const Vec3& wi) const override {
    if (!sameHemisphere(wo, wi)) return 0;
    Vec3 h;
    const float cosH = halfVector(wo, wi, h);
    return cosH > 0 ? distribution_.reflectedPdf(wo, h, cosH, distribution_.D(h)) : 0;
  }
  std::optional<BsdfSample> sample(const Vec3& wo, Point2 u) const override {
    if (absCosTheta(wo) < kMinCosine) return {};
    const Vec3 h = wo.z > 0 ? distribution_.sample(wo, u) : -distribution_.sample(-wo, u);
    const float cosH = glm::dot(wo, h);
    const Vec3 wi = 2 * cosH * h - wo;
    if (!(cosH > 0) || !sameHemisphere(wo, wi) || absCosTheta(wi) < kMinCosine) return {};
    const float D = distribution_.D(h);
    return BsdfSample{value(wo, wi, h, cosH, D), wi, distribution_.reflectedPdf(wo, h, cosH, D)};
  }
  float weight(const Vec3& wo) const override { return luminance(fresnel_(wo.z) * reflectance_); }

 private:
  Spectrum value(const Vec3& wo, const Vec3& wi, const Vec3& h, float cosH, float D) const {
    return D * distribution_.masking(wo, wi, h, cosH) * fresnel_(std::copysign(cosH, wo.z)) *
           reflectance_;
  }

  Spectrum reflectance_;
  Distribution distribution_;
  Fresnel fresnel_;
};

}  // namespace pbrt
