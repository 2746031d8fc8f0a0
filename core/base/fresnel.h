#pragma once
// Reflectance of smooth boundaries for unpolarised light.

#include "core/base/spectrum.h"

namespace pbrt {

// Between dielectrics. eta: index of refraction of the transmitted over the incident side, where
// the incident side is the one with cosTheta > 0.
//
// By Snell's law (eta cos t)^2 = eta^2 - sin^2 i. To lose no digits, it is written with the
// smaller of sin^2 i and cos^2 i: equal indices give exactly no reflection at every angle, and a
// great ratio gives the true critical angle. Not positive: total reflection.
inline float fresnelDielectric(float cosTheta, float eta) {
  if (cosTheta < 0) eta = 1 / eta;
  const float c = std::abs(cosTheta);
  const float t2 = c < 0.7F ? (eta - 1) * (eta + 1) + c * c : eta * eta - (1 - c) * (1 + c);
  if (!(t2 > 0)) return 1;
  const float t = std::sqrt(t2);
  const float parallel = (eta * eta * c - t) / (eta * eta * c + t);
  const float perpendicular = (c - t) / (c + t);
  return 0.5F * (sqr(parallel) + sqr(perpendicular));
}

// Between a dielectric and a conductor of relative complex index eta + i k, in the approximation
// for large eta^2 + k^2, where the refracted direction is nearly the normal (Born and Wolf 1999,
// section 14.2).
inline Spectrum fresnelConductor(float cosTheta, const Spectrum& eta, const Spectrum& k) {
  const float c = std::abs(cosTheta);
  const Spectrum m2 = eta * eta + k * k;
  const Spectrum cross = 2.F * c * eta;
  const Spectrum parallel = (m2 * c * c - cross + 1.F) / (m2 * c * c + cross + 1.F);
  const Spectrum perpendicular = (m2 - cross + c * c) / (m2 + cross + c * c);
  return 0.5F * (parallel + perpendicular);
}

// The same as values that a lobe can hold; called with the cosine of incidence.
struct NoFresnel {
  float operator()(float) const { return 1; }
};
struct DielectricFresnel {
  float eta = 1;
  float operator()(float cosTheta) const { return fresnelDielectric(cosTheta, eta); }
};
struct ConductorFresnel {
  Spectrum eta{1}, k{0};
  Spectrum operator()(float cosTheta) const { return fresnelConductor(cosTheta, eta, k); }
};

}  // namespace pbrt
