#pragma once
// Reflectance of smooth boundaries for unpolarised light.

#include "core/base/spectrum.h"

namespace pbrt {

// (eta cos t)^2 = eta^2 - sin^2 i by Snell's law, where c is the cosine of incidence and eta the
// index of refraction of the transmitted over the incident side. To lose no digits, it is written
// with the smaller of sin^2 i and cos^2 i: equal indices give exactly no reflection at every angle,
// and a great ratio gives the true critical angle. Not positive: total reflection.
inline float refractedCosine2(float c, float eta) {
  return c < 0.7F ? (eta - 1) * (eta + 1) + c * c : eta * eta - (1 - c) * (1 + c);
}

// Between dielectrics. eta: index of refraction of the transmitted over the incident side, where
// the incident side is the one with cosTheta > 0.
inline float fresnelDielectric(float cosTheta, float eta) {
  if (cosTheta < 0) eta = 1 / eta;
  const float c = std::abs(cosTheta);
  const float t2 = refractedCosine2(c, eta);
  if (!(t2 > 0)) return 1;
  const float t = std::sqrt(t2);
  const float parallel = (eta * eta * c - t) / (eta * eta * c + t);
  const float perpendicular = (c - t) / (c + t);
  return 0.5F * (sqr(parallel) + sqr(perpendicular));
}

// The share that a boundary reflects of light that comes evenly from all directions of the incident
// side: the integral of F(c) 2 c dc. Towards a denser medium F is smooth; the other way round it
// follows from reciprocity, 1 - F_diffuse(1 / eta) = (1 - F_diffuse(eta)) / eta^2.
inline float fresnelDiffuse(float eta) {
  if (eta < 1) return 1 - sqr(eta) * (1 - fresnelDiffuse(1 / eta));
  constexpr int n = 256;  // midpoints
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    const float c = (static_cast<float>(i) + 0.5F) / n;
    sum += fresnelDielectric(c, eta) * 2 * c;
  }
  return static_cast<float>(sum / n);
}

// Between a dielectric and a conductor of relative complex index m = eta + i k. With p = a + i b =
// sqrt(m^2 - sin^2), the refracted cosine times m, and c the cosine of incidence, Fresnel's
// equations (Born and Wolf 1999, section 14.2) are
//   F_s = |c - p|^2 / |c + p|^2,   F_p = F_s |c p - sin^2|^2 / |c p + sin^2|^2,
// where |p|^2 = |m^2 - sin^2| and a^2 = (|p|^2 + Re(m^2 - sin^2)) / 2.
inline float fresnelConductor(float cosTheta, float eta, float k) {
  const float c = std::min(1.F, std::abs(cosTheta)), c2 = c * c, sin2 = (1 - c) * (1 + c);
  const float real = (eta - k) * (eta + k) - sin2;
  const float p2 = std::hypot(real, 2 * eta * k);
  const float cross = 2 * c * safeSqrt(0.5F * (p2 + real));
  const float perpendicular = (c2 + p2 - cross) / (c2 + p2 + cross);
  const float parallel =
      (c2 * p2 + sqr(sin2) - cross * sin2) / (c2 * p2 + sqr(sin2) + cross * sin2);
  return std::clamp(0.5F * perpendicular * (1 + parallel), 0.F, 1.F);
}
inline Spectrum fresnelConductor(float cosTheta, const Spectrum& eta, const Spectrum& k) {
  return {fresnelConductor(cosTheta, eta.x, k.x), fresnelConductor(cosTheta, eta.y, k.y),
          fresnelConductor(cosTheta, eta.z, k.z)};
}

// The same in the approximation for large eta^2 + k^2, where the refracted direction is nearly the
// normal; pbrt-v1's and v2's.
inline Spectrum fresnelConductorApproximate(float cosTheta, const Spectrum& eta,
                                            const Spectrum& k) {
  const float c = std::abs(cosTheta);
  const Spectrum m2 = eta * eta + k * k;
  const Spectrum cross = 2.F * c * eta;
  const Spectrum parallel = (m2 * c * c - cross + 1.F) / (m2 * c * c + cross + 1.F);
  const Spectrum perpendicular = (m2 - cross + c * c) / (m2 + cross + c * c);
  return 0.5F * (parallel + perpendicular);
}

// The same as values that a lobe can hold; called with the cosine of incidence, which is negative
// where light comes from below the surface.
struct NoFresnel {
  float operator()(float) const { return 1; }
};
struct NoReflection {
  float operator()(float) const { return 0; }
};
struct DielectricFresnel {
  float eta = 1;
  float operator()(float cosTheta) const { return fresnelDielectric(cosTheta, eta); }
};
// A coat that lies on both sides.
struct TwoSidedFresnel {
  float eta = 1;
  float operator()(float cosTheta) const { return fresnelDielectric(std::abs(cosTheta), eta); }
};
// A pane. Light bounces between its two faces, of reflectance F each:
// F + (1 - F)^2 F (1 + F^2 + F^4 + ...) = 2 F / (1 + F) (Stokes 1862).
struct PaneFresnel {
  float eta = 1;
  float operator()(float cosTheta) const {
    const float F = fresnelDielectric(std::abs(cosTheta), eta);
    return 2 * F / (1 + F);
  }
};
struct ConductorFresnel {
  Spectrum eta{1}, k{0};
  Spectrum operator()(float cosTheta) const { return fresnelConductor(cosTheta, eta, k); }
};
struct ApproximateConductorFresnel {
  Spectrum eta{1}, k{0};
  Spectrum operator()(float cosTheta) const {
    return fresnelConductorApproximate(cosTheta, eta, k);
  }
};

}  // namespace pbrt
