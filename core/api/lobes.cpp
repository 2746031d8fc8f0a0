#include "core/api/lobes.h"

namespace pbrt {

Spectrum Lambertian::f(const Vec3& /*wo*/, const Vec3& /*wi*/) const {
  return f_;
}

OrenNayar::OrenNayar(const Spectrum& reflectance, float sigma)
    : Bxdf(kReflection | kDiffuse), f_(reflectance * kInvPi) {
  const float s2 = sigma * sigma;
  a_ = 1 - s2 / (2 * (s2 + 0.33F));
  b_ = 0.45F * s2 / (s2 + 0.09F);
}

// A + B max(0, cos(phi_i - phi_o)) sin(alpha) tan(beta), where alpha is the larger angle to the
// normal and beta the smaller: the sines of both stand in the dot product of the horizontal parts.
Spectrum OrenNayar::f(const Vec3& wo, const Vec3& wi) const {
  const float horizontal = std::max(0.F, wo.x * wi.x + wo.y * wi.y);
  const float cosBeta = std::max(std::max(absCosTheta(wo), absCosTheta(wi)), kMinCosine);
  return f_ * (a_ + b_ * horizontal / cosBeta);
}

Spectrum SpecularTransmission::f(const Vec3& /*wo*/, const Vec3& /*wi*/) const {
  return Spectrum(0);
}

float SpecularTransmission::pdf(const Vec3& /*wo*/, const Vec3& /*wi*/) const {
  return 0;
}

// Snell's law, in the form of fresnelDielectric().
std::optional<BsdfSample> SpecularTransmission::sample(const Vec3& wo, Point2 /*u*/) const {
  const float eta = wo.z > 0 ? eta_ : 1 / eta_;
  const float t2 = absCosTheta(wo) < 0.7F ? (eta - 1) * (eta + 1) + cos2Theta(wo)
                                          : eta * eta - (wo.x * wo.x + wo.y * wo.y);
  if (!(t2 > 0) || absCosTheta(wo) < kMinCosine) return {};
  const float cosT = std::sqrt(t2) / eta;
  BsdfSample s;
  s.wi = {-wo.x / eta, -wo.y / eta, wo.z > 0 ? -cosT : cosT};
  s.f = (1 - fresnelDielectric(absCosTheta(wo), eta)) / (eta * eta * cosT) * transmittance_;
  s.pdf = 1;
  s.eta = eta;
  return s;
}

}  // namespace pbrt
