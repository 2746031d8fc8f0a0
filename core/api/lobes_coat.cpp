#include "core/api/lobes_coat.h"

#include <map>
#include <mutex>

namespace pbrt {

namespace {

// By midpoints t of n x n cells. u = t^2 (3 - 2 t) crowds them at the edges, where a lobe's samples
// change fast, and du = 6 t (1 - t) dt.
template <class F>
double meanOverSquare(int n, F f) {
  double sum = 0, area = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const Point2 t((static_cast<float>(i) + 0.5F) / static_cast<float>(n),
                     (static_cast<float>(j) + 0.5F) / static_cast<float>(n));
      const Point2 du = 6.F * t * (1.F - t);
      sum += f(t * t * (3.F - 2.F * t)) * du.x * du.y;
      area += du.x * du.y;
    }
  return sum / area;
}

// The share of power from wo that the lobe passes on.
double albedo(const Bxdf& lobe, const Vec3& wo) {
  return meanOverSquare(12, [&](Point2 u) {
    const auto s = lobe.sample(wo, u);
    return s ? s->f.x * absCosTheta(s->wi) * sqr(s->eta) / s->pdf : 0;
  });
}

Vec3 atCosine(float cosTheta) {
  return {std::sqrt((1 - cosTheta) * (1 + cosTheta)), 0, cosTheta};
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
    constexpr int n = 16;
    double sum = 0;
    for (int j = 0; j < n; ++j)
      sum += albedo(back, -atCosine(std::sqrt((static_cast<float>(j) + 0.5F) / n)));
    inside_[i] = i == 0 ? smooth_.insideReflectance() : static_cast<float>(sum / n);
  }
}

std::shared_ptr<const RoughCoatTable> RoughCoatTable::shared(float eta) {
  static std::mutex mutex;
  static std::map<float, std::weak_ptr<const RoughCoatTable>> tables;
  const std::lock_guard lock(mutex);
  std::weak_ptr<const RoughCoatTable>& known = tables[eta];
  std::shared_ptr<const RoughCoatTable> table = known.lock();
  if (!table) known = table = std::make_shared<const RoughCoatTable>(eta);
  return table;
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

Spectrum CoatedConductor::filtered(const Vec3& wo, const Vec3& wi) const {
  const float eta = coat_.eta(), cosH = 0.5F * glm::length(wo + wi);
  const Spectrum C = conductor_(safeSqrt(refractedCosine2(std::min(1.F, cosH), eta)) / eta);
  const float To = coat_.transmittance(wo.z), Ti = coat_.transmittance(wi.z);
  return To * Ti * C / (1.F - (1 - std::max(To, Ti)) * C);
}

Spectrum CoatedConductorFresnel::operator()(float cosTheta) const {
  const float c = std::abs(cosTheta), F = fresnelDielectric(c, eta);
  const Spectrum C = conductor(safeSqrt(refractedCosine2(c, eta)) / eta);
  return F + sqr(1 - F) * C / (1.F - F * C);
}

}  // namespace pbrt
