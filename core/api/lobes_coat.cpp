#include "core/api/lobes_coat.h"

namespace pbrt {

namespace {

// Midpoints of n x n cells of the unit square.
template <class F>
double meanOverSquare(int n, F f) {
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      sum += f(Point2((static_cast<float>(i) + 0.5F) / static_cast<float>(n),
                      (static_cast<float>(j) + 0.5F) / static_cast<float>(n)));
  return sum / (n * n);
}

// The share of power from wo that the lobe passes on.
double albedo(const Bxdf& lobe, const Vec3& wo) {
  return meanOverSquare(16, [&](Point2 u) {
    const auto s = lobe.sample(wo, u);
    return s ? s->f.x * absCosTheta(s->wi) * sqr(s->eta) / s->pdf : 0;
  });
}

Vec3 atCosine(float cosTheta) {
  return {std::sqrt((1 - cosTheta) * (1 + cosTheta)), 0, cosTheta};
}

// The direction in the coat that refraction at the surface makes of w, on the same side.
Vec3 refracted(const Vec3& w, float eta) {
  const float t2 = refractedCosine2(absCosTheta(w), eta);
  return {w.x / eta, w.y / eta, std::copysign(safeSqrt(t2) / eta, w.z)};
}

}  // namespace

float CoatBoundary::tabulated(float cosTheta) const {
  const float x = std::sqrt(std::min(1.F, cosTheta)) * (kCosines - 1);
  const int j = std::min(static_cast<int>(x), kCosines - 2);
  const float t = x - static_cast<float>(j);
  return lerp(next_, lerp(t, row_[0][j], row_[0][j + 1]), lerp(t, row_[1][j], row_[1][j + 1]));
}

RoughCoatTable::RoughCoatTable(float eta) : smooth_(eta) {
  for (int i = 0; i < kWidths; ++i) {
    const float alpha = static_cast<float>(i) / (kWidths - 1);
    const TrowbridgeReitz facets(alpha, alpha);
    const MicrofacetTransmission<TrowbridgeReitz> in(Spectrum(1), facets, eta);
    const MicrofacetReflection<TrowbridgeReitz, DielectricFresnel> back(Spectrum(1), facets, {eta});
    for (int j = 0; j < CoatBoundary::kCosines; ++j) {
      const float c = sqr(static_cast<float>(j) / (CoatBoundary::kCosines - 1));
      transmittance_[i][j] = static_cast<float>(i == 0 ? smooth_.transmittance(c)
                                                       : albedo(in, atCosine(std::max(c, 1e-4F))));
    }
    // Diffuse light has the density 2 c dc.
    constexpr int n = 32;
    double sum = 0;
    for (int j = 0; j < n; ++j)
      sum += albedo(back, -atCosine(std::sqrt((static_cast<float>(j) + 0.5F) / n)));
    inside_[i] = i == 0 ? smooth_.insideReflectance() : static_cast<float>(sum / n);
  }
}

CoatBoundary RoughCoatTable::boundary(float alpha) const {
  CoatBoundary b = smooth_;
  if (!(alpha > 0)) return b;
  const float x = std::min(1.F, alpha) * (kWidths - 1);
  const int i = std::min(static_cast<int>(x), kWidths - 2);
  b.row_ = &transmittance_[i];
  b.next_ = x - static_cast<float>(i);
  b.inside_ = lerp(b.next_, inside_[i], inside_[i + 1]);
  return b;
}

Spectrum CoatedConductor::f(const Vec3& wo, const Vec3& wi) const {
  if (!sameHemisphere(wo, wi)) return Spectrum(0);
  const float eta = coat_.eta();
  const Vec3 o = refracted(wo, eta), i = refracted(wi, eta);
  Vec3 h;
  const float cosH = halfVector(o, i, h);
  if (!(cosH > 0)) return Spectrum(0);
  const Spectrum F = conductor_(cosH);
  const float To = coat_.transmittance(wo.z), Ti = coat_.transmittance(wi.z);
  return facets_.D(h) * facets_.masking(o, i, h, cosH) * (To * Ti / sqr(eta)) * F /
         (1.F - (1 - std::max(To, Ti)) * F);
}

float CoatedConductor::pdf(const Vec3& wo, const Vec3& wi) const {
  if (!sameHemisphere(wo, wi)) return 0;
  const float eta = coat_.eta();
  const Vec3 o = refracted(wo, eta), i = refracted(wi, eta);
  Vec3 h;
  const float cosH = halfVector(o, i, h);
  if (!(cosH > 0)) return 0;
  return facets_.reflectedPdf(o, cosH, facets_.D(h)) * absCosTheta(wi) /
         (sqr(eta) * absCosTheta(i));
}

std::optional<BsdfSample> CoatedConductor::sample(const Vec3& wo, Point2 u) const {
  if (absCosTheta(wo) < kMinCosine) return {};
  const float eta = coat_.eta();
  const Vec3 o = refracted(wo, eta);
  const Vec3 h = o.z > 0 ? facets_.sample(o, u) : -facets_.sample(-o, u);
  const Vec3 i = 2 * glm::dot(o, h) * h - o;
  const float t2 = refractedCosine2(absCosTheta(i), 1 / eta);
  if (!sameHemisphere(o, i) || !(t2 > 0)) return {};
  BsdfSample s;
  s.wi = {eta * i.x, eta * i.y, std::copysign(eta * std::sqrt(t2), i.z)};
  s.pdf = pdf(wo, s.wi);
  if (!(s.pdf > 0)) return {};
  s.f = f(wo, s.wi);
  return s;
}

Spectrum CoatedConductorFresnel::operator()(float cosTheta) const {
  const float c = std::abs(cosTheta), F = fresnelDielectric(c, eta);
  const Spectrum C = conductor(safeSqrt(refractedCosine2(c, eta)) / eta);
  return F + sqr(1 - F) * C / (1.F - F * C);
}

}  // namespace pbrt
