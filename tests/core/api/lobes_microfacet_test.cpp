#include "core/api/lobes_microfacet.h"

#include <gtest/gtest.h>

#include "core/base/rng.h"

namespace pbrt {
namespace {

using Refraction = MicrofacetTransmission<TrowbridgeReitz>;

double ggx(double cosH, double alpha) {
  const double tan2 = 1 / (cosH * cosH) - 1;
  return alpha * alpha / (std::numbers::pi * std::pow(cosH, 4) * std::pow(alpha * alpha + tan2, 2));
}

double lambda(double cosine, double alpha) {
  return (std::sqrt(1 + alpha * alpha * (1 / (cosine * cosine) - 1)) - 1) / 2;
}

// Walter et al. 2007, equations 16 and 21, in double, as light transport: from i to o.
double walter(const DVec3& i, const DVec3& o, double ni, double no, double alpha) {
  DVec3 h = glm::normalize(ni * i + no * o);
  if (h.z < 0) h = -h;
  double ih = glm::dot(i, h), oh = glm::dot(o, h);
  if (ih * i.z <= 0 || oh * o.z <= 0) return 0;
  const double G = 1 / (1 + lambda(std::abs(i.z), alpha) + lambda(std::abs(o.z), alpha));
  ih = std::abs(ih);
  const double sinT = ni / no * std::sqrt(1 - ih * ih), cosT = std::sqrt(1 - sinT * sinT);
  const double rs = (ni * ih - no * cosT) / (ni * ih + no * cosT);
  const double rp = (no * ih - ni * cosT) / (no * ih + ni * cosT);
  const double F = (rs * rs + rp * rp) / 2;
  const double denominator = ni * glm::dot(i, h) + no * oh;
  return ih * std::abs(oh) / std::abs(i.z * o.z) * no * no * (1 - F) * G *
         ggx(std::abs(h.z), alpha) / (denominator * denominator);
}

TEST(MicrofacetTransmission, IsWalters) {
  for (const float eta : {1.5F, 2.4F, 0.7F, 1.05F}) {
    const Refraction lobe(Spectrum(1), {0.4F, 0.4F}, eta);
    Rng rng(1);
    int lit = 0;
    for (int k = 0; k < 2000; ++k) {
      const Vec3 wo = uniformSphere({rng.uniform(), rng.uniform()});
      const auto s = lobe.sample(wo, {rng.uniform(), rng.uniform()});
      if (!s) continue;
      const double no = wo.z > 0 ? 1 : eta, ni = wo.z > 0 ? eta : 1;
      const double f = walter(glm::normalize(DVec3(s->wi)), glm::normalize(DVec3(wo)), ni, no, 0.4);
      ASSERT_NEAR(s->f.x, f, 2e-3 * f + 1e-6) << eta << " " << wo.z << " " << s->wi.z;
      ++lit;
    }
    EXPECT_GT(lit, 1000);
  }
}

TEST(MicrofacetTransmission, SharpFacetsRefractBySnell) {
  const Refraction lobe(Spectrum(1), {1e-3F, 1e-3F}, 1.5F);
  for (const float z : {0.9F, 0.3F}) {
    const Vec3 wo(std::sqrt(1 - z * z), 0, z);
    double through = 0;
    Rng rng(1);
    for (int i = 0; i < 1000; ++i) {
      const auto s = lobe.sample(wo, {rng.uniform(), rng.uniform()});
      ASSERT_TRUE(s);
      EXPECT_NEAR(s->wi.x, -wo.x / 1.5F, 0.1);
      EXPECT_EQ(s->eta, 1.5F);
      through += s->f.x * std::abs(s->wi.z) * sqr(s->eta) / s->pdf / 1000;
    }
    EXPECT_NEAR(through, 1 - fresnelDielectric(z, 1.5F), 1e-3);
  }
}

TEST(FresnelBlend, IsTheBooks) {
  const FresnelBlend<TrowbridgeReitz> lobe(Spectrum(0.6F), Spectrum(0.1F), {0.3F, 0.3F});
  Rng rng(1);
  for (int k = 0; k < 1000; ++k) {
    const DVec3 o(cosHemisphere({rng.uniform(), rng.uniform()}));
    const DVec3 i(cosHemisphere({rng.uniform(), rng.uniform()}));
    if (std::min(o.z, i.z) < 0.02) continue;
    const DVec3 h = glm::normalize(o + i);
    const double oh = glm::dot(glm::normalize(o), h);
    const double diffuse = 28 * 0.6 / (23 * std::numbers::pi) * 0.9 *
                           (1 - std::pow(1 - o.z / 2, 5)) * (1 - std::pow(1 - i.z / 2, 5));
    const double specular =
        ggx(h.z, 0.3) / (4 * oh * std::max(o.z, i.z)) * (0.1 + 0.9 * std::pow(1 - oh, 5));
    ASSERT_NEAR(lobe.f(Vec3(o), Vec3(i)).x, diffuse + specular, 1e-3 * (diffuse + specular));
  }
}

TEST(Through, IsTheReflectionMirrored) {
  using Gloss = MicrofacetReflection<TrowbridgeReitz, NoFresnel>;
  const Gloss gloss(Spectrum(0.5F), {0.2F, 0.4F}, {});
  const Through<Gloss> through(gloss);
  EXPECT_EQ(through.flags(), kTransmission | kGlossy);
  const Vec3 wo = glm::normalize(Vec3(1, 2, -3)), wi = glm::normalize(Vec3(-1, -1, -3));
  const Vec3 below(wi.x, wi.y, -wi.z);
  EXPECT_EQ(through.f(wo, below), gloss.f(wo, wi));
  EXPECT_EQ(through.pdf(wo, below), gloss.pdf(wo, wi));
  EXPECT_EQ(through.pdf(wo, wi), 0);
  const auto s = through.sample(wo, {0.3F, 0.6F}), r = gloss.sample(wo, {0.3F, 0.6F});
  ASSERT_TRUE(s && r);
  EXPECT_EQ(s->wi, Vec3(r->wi.x, r->wi.y, -r->wi.z));
  EXPECT_EQ(s->f, r->f);
}

}  // namespace
}  // namespace pbrt
