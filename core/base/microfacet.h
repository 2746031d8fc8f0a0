#pragma once
// Distributions of microfacet normals h about the surface normal z, each with its masking.
// D(h): density of facets, such that the integral of D(h) cos(h) over the hemisphere is 1.
// masking(wo, wi, h, cosH): G / (4 |cos o| |cos i|), which Torrance and Sparrow's model (1967)
//   multiplies with D and the Fresnel term; both cosines are non-zero.
// sample(wo, u): a normal for wo in the upper hemisphere.
// reflectedPdf(wo, cosH, D): solid-angle density of the direction that such a normal reflects wo
//   into; d wh = d wi / (4 wo.h).
// cosH is wo.h = wi.h >= 0 throughout.

#include "core/base/frame.h"
#include "core/base/warp.h"

namespace pbrt {

// Blinn 1977: D is a power of the cosine. Masking by V-shaped grooves.
class Blinn {
 public:
  // Sharper than the last exponent float cosines cannot tell from a mirror.
  explicit Blinn(float roughness) : exponent_(roughness > 1e-4F ? 1 / roughness : 1e4F) {}

  float D(const Vec3& h) const {
    return (exponent_ + 2) * (kInvPi / 2) * std::pow(absCosTheta(h), exponent_);
  }
  float masking(const Vec3& wo, const Vec3& wi, const Vec3& h, float cosH) const {
    const float o = absCosTheta(wo), i = absCosTheta(wi);
    const float G = std::min(1.F, 2 * absCosTheta(h) * std::min(o, i) / cosH);
    return G / (4 * o * i);
  }
  // Density proportional to a power of the cosine: cdf^-1(u) = u^(1 / (exponent + 1)).
  Vec3 sample(const Vec3& /*wo*/, Point2 u) const {
    const float cosTheta = std::pow(u.x, 1 / (exponent_ + 1));
    const float sinTheta = safeSqrt(1 - cosTheta * cosTheta);
    const float phi = 2 * kPi * u.y;
    return {sinTheta * std::cos(phi), sinTheta * std::sin(phi), cosTheta};
  }
  float reflectedPdf(const Vec3& /*wo*/, float cosH, float D) const {
    return D * (exponent_ + 1) / (exponent_ + 2) / (4 * cosH);
  }

 private:
  float exponent_;
};

// Trowbridge and Reitz 1975 (GGX: Walter et al. 2007): slopes of an ellipsoid with the widths
// alphaX and alphaY. Height-correlated Smith masking (Heitz 2014, equation 99).
//
// G1(w) = 2 cos / (cos + s) and G = 2 cos o cos i / (cos i s_o + cos o s_i), where
// s(w) = sqrt(cos^2 + alphaX^2 w.x^2 + alphaY^2 w.y^2): the cosines cancel against the model's.
class TrowbridgeReitz {
 public:
  TrowbridgeReitz(float alphaX, float alphaY)
      : alphaX_(std::max(1e-3F, alphaX)), alphaY_(std::max(1e-3F, alphaY)) {}
  // pbrt-v3's map from its roughness in [0, 1] to alpha: a polynomial in the logarithm.
  static float alpha(float roughness) {
    const float x = std::log(std::max(1e-3F, roughness));
    return 1.62142F + x * (0.819955F + x * (0.1734F + x * (0.0171201F + x * 0.000640711F)));
  }

  float D(const Vec3& h) const {
    const float k = sqr(h.x / alphaX_) + sqr(h.y / alphaY_) + sqr(h.z);
    return 1 / (kPi * alphaX_ * alphaY_ * k * k);
  }
  float masking(const Vec3& wo, const Vec3& wi, const Vec3& /*h*/, float /*cosH*/) const {
    return 0.5F / (absCosTheta(wi) * stretchedLength(wo) + absCosTheta(wo) * stretchedLength(wi));
  }
  // The normals visible from wo: stretch the ellipsoid to a sphere, whose visible half projects
  // to a disk, one half of it squeezed (Heitz 2018, listing 1).
  Vec3 sample(const Vec3& wo, Point2 u) const {
    const Vec3 v = glm::normalize(Vec3(alphaX_ * wo.x, alphaY_ * wo.y, wo.z));
    const float xy2 = v.x * v.x + v.y * v.y;
    const Vec3 t1 = xy2 > 0 ? Vec3(-v.y, v.x, 0) / std::sqrt(xy2) : Vec3(1, 0, 0);
    const Vec3 t2 = glm::cross(v, t1);
    Point2 d = concentricDisk(u);
    d.y = lerp(0.5F * (1 + v.z), safeSqrt(1 - d.x * d.x), d.y);
    const Vec3 n = d.x * t1 + d.y * t2 + safeSqrt(1 - d.x * d.x - d.y * d.y) * v;
    return glm::normalize(Vec3(alphaX_ * n.x, alphaY_ * n.y, std::max(1e-6F, n.z)));
  }
  // Visible normals have density D G1(wo) wo.h / cos o.
  float reflectedPdf(const Vec3& wo, float /*cosH*/, float D) const {
    return 0.5F * D / (absCosTheta(wo) + stretchedLength(wo));
  }

 private:
  float stretchedLength(const Vec3& w) const {
    return std::sqrt(sqr(w.z) + sqr(alphaX_ * w.x) + sqr(alphaY_ * w.y));
  }

  float alphaX_, alphaY_;
};

}  // namespace pbrt
