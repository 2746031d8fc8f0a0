#include "core/api/lobes_lafortune.h"

#include "core/base/warp.h"

namespace pbrt {

namespace {

// q of one colour.
Vec3 axis(const GeneralizedCosine& lobe, int colour, const Vec3& wo) {
  return {lobe.xy[colour] * wo.x, lobe.xy[colour] * wo.y, lobe.z[colour] * wo.z};
}

// About the unit vector `axis`, with density (n + 1) / (2 pi) cos^n.
Vec3 cosinePower(const Vec3& axis, float n, Point2 u) {
  const float c = std::pow(u.x, 1 / (n + 1)), s = safeSqrt(1 - c * c), phi = 2 * kPi * u.y;
  return Frame::fromZ(axis).fromLocal({s * std::cos(phi), s * std::sin(phi), c});
}

// Of f and the cosine to the normal, over the directions above the surface: they are chosen with
// the density of cosinePower() about q, or about its shadow on the surface where q is below. To
// these the integral is 2 pi / (n + 1) times the mean of w.z (q.w / axis.w)^n; about q itself that
// ratio is |q|.
float integral(const GeneralizedCosine& lobe, int colour, float cosTheta) {
  constexpr int k = 24;
  const float n = lobe.exponent[colour];
  const Vec3 q = axis(lobe, colour, {std::sqrt((1 - cosTheta) * (1 + cosTheta)), 0, cosTheta});
  const Vec3 about(q.x, 0, std::max(0.F, q.z));
  if (!(lengthSquared(about) > 0)) return 0;
  const Vec3 unit = glm::normalize(about);
  float sum = 0;
  for (int i = 0; i < k; ++i)
    for (int j = 0; j < k; ++j) {
      const Point2 u((static_cast<float>(i) + 0.5F) / k, (static_cast<float>(j) + 0.5F) / k);
      const Vec3 w = cosinePower(unit, n, u);
      const float ratio = std::max(0.F, glm::dot(q, w) / glm::dot(unit, w));
      sum += std::max(0.F, w.z) * std::pow(ratio, n);
    }
  return 2 * kPi / (n + 1) * sum / (k * k);
}

}  // namespace

LafortuneModel::LafortuneModel(const LafortuneFit& fit) : fit_(fit) {
  for (int j = 0; j < kCosines; ++j) {
    const float c = static_cast<float>(j) / (kCosines - 1);
    Spectrum all(0);
    for (int l = 0; l < LafortuneFit::kLobes; ++l) {
      Spectrum one;
      for (int colour = 0; colour < 3; ++colour) one[colour] = integral(fit_.lobes[l], colour, c);
      albedo_[l][j] = luminance(one);
      all += one;
    }
    kept_[j] = glm::min((1.F - fit_.diffuse) / all, 1.F);
  }
}

LafortuneModel::Cell LafortuneModel::cell(float cosTheta) {
  const float x = std::min(1.F, std::abs(cosTheta)) * (kCosines - 1);
  const int j = std::min(static_cast<int>(x), kCosines - 2);
  return {j, x - static_cast<float>(j)};
}

Spectrum LafortuneModel::kept(float cosTheta) const {
  const Cell at = cell(cosTheta);
  return (1 - at.t) * kept_[at.j] + at.t * kept_[at.j + 1];
}

float LafortuneModel::albedo(int lobe, float cosTheta) const {
  const Cell at = cell(cosTheta);
  return lerp(at.t, albedo_[lobe][at.j], albedo_[lobe][at.j + 1]);
}

Spectrum LafortuneLobe::f(const Vec3& wo, const Vec3& wi) const {
  if (!sameHemisphere(wo, wi)) return Spectrum(0);
  const GeneralizedCosine& lobe = model_.fit().lobes[lobe_];
  const Spectrum base = lobe.xy * (wo.x * wi.x + wo.y * wi.y) + lobe.z * (wo.z * wi.z);
  return glm::pow(glm::max(base, 0.F), lobe.exponent) *
         glm::min(model_.kept(wo.z), model_.kept(wi.z));
}

float LafortuneLobe::pdf(const Vec3& wo, const Vec3& wi) const {
  if (!sameHemisphere(wo, wi)) return 0;
  const GeneralizedCosine& lobe = model_.fit().lobes[lobe_];
  float sum = 0;
  for (int colour = 0; colour < 3; ++colour) {
    const Vec3 q = axis(lobe, colour, wo);
    const float n = lobe.exponent[colour], cosine = glm::dot(q, wi) / glm::length(q);
    sum += !sameHemisphere(q, wo) ? cosHemispherePdf(absCosTheta(wi))
                                  : (n + 1) / (2 * kPi) * std::pow(std::max(0.F, cosine), n);
  }
  return sum / 3;
}

std::optional<BsdfSample> LafortuneLobe::sample(const Vec3& wo, Point2 u) const {
  const GeneralizedCosine& lobe = model_.fit().lobes[lobe_];
  const int colour = std::min(static_cast<int>(3 * u.x), 2);
  u.x = std::min(3 * u.x - static_cast<float>(colour), kOneMinusEpsilon);
  const Vec3 q = axis(lobe, colour, wo);
  BsdfSample s;
  if (sameHemisphere(q, wo)) {
    s.wi = cosinePower(glm::normalize(q), lobe.exponent[colour], u);
  } else {
    s.wi = cosHemisphere(u);
    if (wo.z < 0) s.wi.z = -s.wi.z;
  }
  s.pdf = pdf(wo, s.wi);
  if (!(s.pdf > 0)) return {};
  s.f = f(wo, s.wi);
  return s;
}

float LafortuneLobe::weight(const Vec3& wo) const {
  return luminance(model_.kept(wo.z)) * model_.albedo(lobe_, wo.z);
}

}  // namespace pbrt
