#pragma once
// Distributions of microfacet normals h about the surface normal z, each with its masking.
// D(h): density of facets, such that the integral of D(h) cos(h) over the hemisphere is 1.
// masking(wo, wi, h, cosH): G / (4 |cos o| |cos i|), which Torrance and Sparrow's model (1967)
//   multiplies with D and the Fresnel term; both cosines are non-zero.
// sample(wo, u): a normal in the upper hemisphere that wo sees.
// reflectedPdf(wo, h, cosH, D): solid-angle density of the direction that such a normal reflects wo
//   into; d wh = d wi / (4 wo.h).
// cosH is wo.h = wi.h >= 0 throughout.

#include "core/base/frame.h"
#include "core/base/warp.h"

namespace pbrt {

// Blinn 1977: D is a power of the cosine. Masking by V-shaped grooves. With two roughnesses the
// exponent goes from that of the x axis to that of the y axis with the azimuth,
// e = ex cos^2 phi + ey sin^2 phi (Ashikhmin and Shirley 2000, equation 4).
class Blinn {
 public:
  explicit Blinn(float roughness) : Blinn(roughness, roughness) {}
  Blinn(float roughnessX, float roughnessY)
      : ex_(exponent(roughnessX)), ey_(exponent(roughnessY)) {}

  float D(const Vec3& h) const {
    return std::sqrt((ex_ + 2) * (ey_ + 2)) * (kInvPi / 2) * std::pow(absCosTheta(h), exponent(h));
  }
  float masking(const Vec3& wo, const Vec3& wi, const Vec3& h, float cosH) const {
    const float o = absCosTheta(wo), i = absCosTheta(wi);
    const float G = std::min(1.F, 2 * absCosTheta(h) * std::min(o, i) / cosH);
    return G / (4 * o * i);
  }
  // By D cos(h), whose azimuths are those of an ellipse, which has uniform ones when stretched to a
  // circle; then cdf^-1(u) = u^(1 / (e + 2)). A groove has the facets h and h' (mirrored about z):
  // if wo does not see the one, it is replaced by the other, which then counts twice.
  Vec3 sample(const Vec3& wo, Point2 u) const {
    const float circle = 2 * kPi * u.y;
    Vec3 h(std::sqrt(ey_ + 2) * std::cos(circle), std::sqrt(ex_ + 2) * std::sin(circle), 0);
    h /= std::sqrt(lengthSquared(h));
    const float cosTheta = std::pow(u.x, 1 / (exponent(h) + 2));
    const float sinTheta = safeSqrt(1 - cosTheta * cosTheta);
    h = {sinTheta * h.x, sinTheta * h.y, cosTheta};
    return glm::dot(wo, h) < 0 ? Vec3(-h.x, -h.y, h.z) : h;
  }
  float reflectedPdf(const Vec3& wo, const Vec3& h, float cosH, float D) const {
    const float toOther = 2 * wo.z * h.z - cosH;  // wo.h'
    return D * absCosTheta(h) * (toOther < 0 ? 2 : 1) / (4 * cosH);
  }

 private:
  // Sharper than the last exponent float cosines cannot tell from a mirror.
  static float exponent(float roughness) { return roughness > 1e-4F ? 1 / roughness : 1e4F; }
  float exponent(const Vec3& h) const {
    const float x2 = sqr(h.x), y2 = sqr(h.y);
    return x2 + y2 > 0 ? (ex_ * x2 + ey_ * y2) / (x2 + y2) : ex_;
  }

  float ex_, ey_;
};

// Trowbridge and Reitz 1975 (GGX: Walter et al. 2007): slopes of an ellipsoid with the widths
// alphaX and alphaY. Height-correlated Smith masking (Heitz 2014, equation 99).
//
// G1(w) = 2 cos / (cos + s) and G = 2 cos o cos i / (cos i s_o + cos o s_i), where
// s(w) = sqrt(cos^2 + alphaX^2 w.x^2 + alphaY^2 w.y^2): the cosines cancel against the model's.
class TrowbridgeReitz {
 public:
  // Narrower ones cannot be told from a mirror, wider ones are all of upright facets.
  static constexpr float kMin = 1e-3F, kMax = 10;

  TrowbridgeReitz(float alphaX, float alphaY)
      : alphaX_(std::min(kMax, std::max(kMin, alphaX))),
        alphaY_(std::min(kMax, std::max(kMin, alphaY))) {}
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
  float reflectedPdf(const Vec3& wo, const Vec3& /*h*/, float /*cosH*/, float D) const {
    return 0.5F * D / (absCosTheta(wo) + stretchedLength(wo));
  }

 private:
  float stretchedLength(const Vec3& w) const {
    return std::sqrt(sqr(w.z) + sqr(alphaX_ * w.x) + sqr(alphaY_ * w.y));
  }

  float alphaX_, alphaY_;
};

// Beckmann and Spizzichino 1963: normally distributed slopes, of the variances alphaX^2 / 2 and
// alphaY^2 / 2. Height-correlated Smith masking (Heitz 2014, equations 72 and 99):
//   G = 1 / (1 + L(o) + L(i)),  L(w) = (erf(a) - 1) / 2 + exp(-a^2) / (2 a sqrt(pi)),
// where 1 / a is the slope of w's horizontal part over its height, in units of the widths.
class Beckmann {
 public:
  Beckmann(float alphaX, float alphaY)
      : alphaX_(std::clamp(alphaX, TrowbridgeReitz::kMin, TrowbridgeReitz::kMax)),
        alphaY_(std::clamp(alphaY, TrowbridgeReitz::kMin, TrowbridgeReitz::kMax)) {}

  float D(const Vec3& h) const {
    const float cos2 = sqr(h.z), slope2 = (sqr(h.x / alphaX_) + sqr(h.y / alphaY_)) / cos2;
    return slope2 < 80 ? std::exp(-slope2) / (kPi * alphaX_ * alphaY_ * sqr(cos2)) : 0;
  }
  float masking(const Vec3& wo, const Vec3& wi, const Vec3& /*h*/, float /*cosH*/) const {
    const float o = absCosTheta(wo), i = absCosTheta(wi);
    return 0.25F / (o * i + i * hidden(wo) + o * hidden(wi));
  }
  // The normals visible from wo (Heitz and d'Eon 2014, section 4): stretched to widths of 1, wo is
  // at theta from the normal and sees the slopes x towards it with the density below, and all
  // slopes across.
  Vec3 sample(const Vec3& wo, Point2 u) const {
    const Vec3 v = glm::normalize(Vec3(alphaX_ * wo.x, alphaY_ * wo.y, wo.z));
    const float sinTheta = std::sqrt(v.x * v.x + v.y * v.y);
    const Vec2 towards = sinTheta > 0 ? Vec2(v) / sinTheta : Vec2(1, 0);
    const float x = visibleSlope(v.z, sinTheta, u.x), y = visibleSlope(1, 0, u.y);
    return glm::normalize(Vec3(alphaX_ * (x * towards.x - y * towards.y),
                               alphaY_ * (x * towards.y + y * towards.x), 1));
  }
  float reflectedPdf(const Vec3& wo, const Vec3& /*h*/, float /*cosH*/, float D) const {
    return 0.25F * D / (absCosTheta(wo) + hidden(wo));
  }

 private:
  static constexpr float kInvRootPi = std::numbers::inv_sqrtpi_v<float>;

  float hidden(const Vec3& w) const {  // L(w) |cos w|
    const float o = absCosTheta(w), s = std::sqrt(sqr(alphaX_ * w.x) + sqr(alphaY_ * w.y));
    if (o > 4 * s) return 0;
    const float a = o / s;
    return 0.5F * (kInvRootPi * s * std::exp(-a * a) - o * std::erfc(a));
  }
  // Slopes s have the density (cos + s sin) exp(-s^2) where that is positive, from s0 = -cot on.
  // Its integral from s on, which is to be the share u of the whole, is
  //   S(s) = cos erfc(s) / 2 + sin exp(-s^2) / (2 sqrt(pi))       (times sqrt(pi)).
  // By Newton's steps, and by halving where they lead out of the bracket.
  static float visibleSlope(float cosTheta, float sinTheta, float u) {
    const auto beyond = [&](float s) {
      return 0.5F * (cosTheta * std::erfc(s) + kInvRootPi * sinTheta * std::exp(-s * s));
    };
    float low = std::max(-kSteepest, -cosTheta / std::max(sinTheta, 1e-6F)), high = kSteepest;
    const float wanted = u * beyond(low);
    float s = 0.5F * (std::max(low, -1.F) + 1);
    for (int i = 0; i < 30; ++i) {
      const float excess = beyond(s) - wanted;
      (excess > 0 ? low : high) = s;
      const float slope = kInvRootPi * (cosTheta + s * sinTheta) * std::exp(-s * s);
      float next = s + excess / slope;
      if (!(next > low && next < high)) next = 0.5F * (low + high);
      if (std::abs(next - s) < 1e-6F) return next;
      s = next;
    }
    return s;
  }
  static constexpr float kSteepest = 5;  // exp(-s^2) is nothing beside 1

  float alphaX_, alphaY_;
};

}  // namespace pbrt
