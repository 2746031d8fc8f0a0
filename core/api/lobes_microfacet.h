#pragma once
// Rough glass, and the gloss of a varnish.

#include "core/api/lobes.h"

namespace pbrt {

// Refraction by small facets (Walter et al. 2007, section 5) into a medium whose index over the
// outer one is eta (z points outward). Of two indices that differ by less than kLeastBend, as of
// equal ones, no facet bends light visibly: SpecularTransmission is what is wanted there.
//
// With the index of wo's side as unit, eta that of wi's side, and h on wo's side,
//   h ~ -(wo + eta wi),  dh / dwi = eta^2 |wi.h| / (wo.h + eta wi.h)^2                (equation 17)
//   f = (1 - F) G D (wo.h) |wi.h| / (|cos o| |cos i| (wo.h + eta wi.h)^2)             (equation 21)
// for radiance, which is denser by eta^2 in wi's medium: eta^2 f(wo, wi) = f(wi, wo).
template <class Distribution>
class MicrofacetTransmission final : public Bxdf {
 public:
  static constexpr float kLeastBend = 1e-3F;

  MicrofacetTransmission(const Spectrum& transmittance, const Distribution& distribution, float eta)
      : Bxdf(kTransmission | kGlossy),
        transmittance_(transmittance),
        distribution_(distribution),
        eta_(eta) {}

  Spectrum f(const Vec3& wo, const Vec3& wi) const override {
    const Facet facet = between(wo, wi);
    return facet.cosI < 0 ? value(wo, wi, facet, distribution_.D(facet.h)) : Spectrum(0);
  }
  float pdf(const Vec3& wo, const Vec3& wi) const override {
    const Facet facet = between(wo, wi);
    return facet.cosI < 0 ? density(wo, facet, distribution_.D(facet.h)) : 0;
  }
  std::optional<BsdfSample> sample(const Vec3& wo, Point2 u) const override {
    if (absCosTheta(wo) < kMinCosine) return {};
    Facet facet;
    facet.h = wo.z > 0 ? distribution_.sample(wo, u) : -distribution_.sample(-wo, u);
    facet.eta = wo.z > 0 ? eta_ : 1 / eta_;
    facet.cosO = glm::dot(wo, facet.h);
    const float t2 = refractedCosine2(facet.cosO, facet.eta);
    if (!(facet.cosO > 0 && t2 > 0)) return {};
    facet.cosI = -std::sqrt(t2) / facet.eta;
    const Vec3 wi = (facet.cosO / facet.eta + facet.cosI) * facet.h - wo / facet.eta;
    if (sameHemisphere(wo, wi) || absCosTheta(wi) < kMinCosine) return {};
    const float D = distribution_.D(facet.h);
    BsdfSample s;
    s.f = value(wo, wi, facet, D);
    s.wi = wi;
    s.pdf = density(wo, facet, D);
    s.eta = facet.eta;
    return s;
  }
  // Where the surface as a whole reflects totally, some facets do not.
  float weight(const Vec3& wo) const override {
    return std::max(0.3F, 1 - fresnelDielectric(wo.z, eta_)) * luminance(transmittance_);
  }

 private:
  // The normal h on wo's side of a facet that refracts one direction into the other.
  struct Facet {
    Vec3 h{0};
    float cosO = 0, cosI = 0;  // wo.h > 0 and wi.h < 0; zero if there is none
    float eta = 1;             // index of wi's side over that of wo's
  };
  Facet between(const Vec3& wo, const Vec3& wi) const {
    Facet facet;
    if (wo.z * wi.z >= 0 || std::min(absCosTheta(wo), absCosTheta(wi)) < kMinCosine) return facet;
    facet.eta = wo.z > 0 ? eta_ : 1 / eta_;
    Vec3 h = wo + facet.eta * wi;
    const float length2 = lengthSquared(h);
    if (!(length2 > 0)) return facet;
    h *= std::copysign(1 / std::sqrt(length2), h.z * wo.z);
    const float cosO = glm::dot(wo, h), cosI = glm::dot(wi, h);
    if (!(cosO > 0 && cosI < 0)) return facet;
    facet.h = h;
    facet.cosO = cosO;
    facet.cosI = cosI;
    return facet;
  }
  float jacobian(const Facet& facet) const {  // over eta^2
    return -facet.cosI / sqr(facet.cosO + facet.eta * facet.cosI);
  }
  Spectrum value(const Vec3& wo, const Vec3& wi, const Facet& facet, float D) const {
    const float G = 4 * distribution_.masking(wo, wi, facet.h, facet.cosO);  // over the cosines
    // The same from both sides; from the rarer one no digits cancel at the critical angle.
    const float F = fresnelDielectric(facet.eta > 1 ? facet.cosO : facet.cosI, facet.eta);
    return D * G * (1 - F) * facet.cosO * jacobian(facet) * transmittance_;
  }
  float density(const Vec3& wo, const Facet& facet, float D) const {
    const float visible = 4 * facet.cosO * distribution_.reflectedPdf(wo, facet.h, facet.cosO, D);
    return visible * sqr(facet.eta) * jacobian(facet);
  }

  Spectrum transmittance_;
  Distribution distribution_;
  float eta_;
};

// Gloss over a diffuse base which gets what the gloss leaves (Ashikhmin and Shirley 2000, equations
// 3 and 5, as in pbrt with any distribution of facets and with none of its masking). Both are
// reciprocal and together keep energy. The Fresnel term is Schlick's.
template <class Distribution>
class FresnelBlend final : public Bxdf {
 public:
  FresnelBlend(const Spectrum& diffuse, const Spectrum& specular, const Distribution& distribution)
      : Bxdf(kReflection | kGlossy),
        diffuse_(28 / (23 * kPi) * diffuse * (1.F - specular)),
        specular_(specular),
        distribution_(distribution) {}

  Spectrum f(const Vec3& wo, const Vec3& wi) const override {
    if (!sameHemisphere(wo, wi)) return Spectrum(0);
    const float o = absCosTheta(wo), i = absCosTheta(wi);
    const Spectrum base = diffuse_ * (1 - pow5(1 - 0.5F * o)) * (1 - pow5(1 - 0.5F * i));
    Vec3 h;
    const float cosH = halfVector(wo, wi, h);
    if (!(cosH > 0)) return base;
    const Spectrum F = specular_ + pow5(1 - cosH) * (1.F - specular_);
    return base + distribution_.D(h) / (4 * cosH * std::max(o, i)) * F;
  }
  // The base's share of the samples goes by the cosine, the rest by the facets.
  float pdf(const Vec3& wo, const Vec3& wi) const override {
    if (!sameHemisphere(wo, wi)) return 0;
    Vec3 h;
    const float cosH = halfVector(wo, wi, h), base = basesShare(wo);
    const float facets = cosH > 0 ? distribution_.reflectedPdf(wo, h, cosH, distribution_.D(h)) : 0;
    return base * cosHemispherePdf(absCosTheta(wi)) + (1 - base) * facets;
  }
  std::optional<BsdfSample> sample(const Vec3& wo, Point2 u) const override {
    if (absCosTheta(wo) < kMinCosine) return {};
    BsdfSample s;
    const float base = basesShare(wo);
    if (u.x < base) {
      s.wi = cosHemisphere({std::min(u.x / base, kOneMinusEpsilon), u.y});
      if (wo.z < 0) s.wi.z = -s.wi.z;
    } else {
      u.x = std::min((u.x - base) / (1 - base), kOneMinusEpsilon);
      const Vec3 h = wo.z > 0 ? distribution_.sample(wo, u) : -distribution_.sample(-wo, u);
      s.wi = 2 * glm::dot(wo, h) * h - wo;
    }
    s.pdf = pdf(wo, s.wi);
    if (!(s.pdf > 0)) return {};
    s.f = f(wo, s.wi);
    return s;
  }
  float weight(const Vec3& wo) const override { return basesAlbedo(wo) + glossAlbedo(wo); }

 private:
  static float pow5(float x) { return sqr(sqr(x)) * x; }
  // The base's, the integral of its last factor being 23 pi / 28; and a guess of the gloss's.
  float basesAlbedo(const Vec3& wo) const {
    return 23 * kPi / 28 * luminance(diffuse_) * (1 - pow5(1 - 0.5F * absCosTheta(wo)));
  }
  float glossAlbedo(const Vec3& wo) const {
    const float r = luminance(specular_);
    return r + pow5(1 - absCosTheta(wo)) * (1 - r);
  }
  float basesShare(const Vec3& wo) const {
    const float base = basesAlbedo(wo);
    return base / (base + glossAlbedo(wo));
  }

  Spectrum diffuse_, specular_;
  Distribution distribution_;
};

}  // namespace pbrt
