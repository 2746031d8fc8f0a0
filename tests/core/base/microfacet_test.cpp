// Laws of microfacet distributions.

#include "core/base/microfacet.h"

#include <gtest/gtest.h>

#include "core/base/rng.h"

namespace pbrt {
namespace {

// The integral over the upper hemisphere, by the midpoint rule in cos^(1/4), which resolves peaks
// about the normal: with x = 1 - (1 - z), z = 1 - t^4, dz = 4 t^3 dt.
template <class F>
double overHemisphere(F f) {
  constexpr int n = 600, m = 64;
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    const double t = (i + 0.5) / n, h = t * t * t * t;
    const double z = 1 - h, r = std::sqrt(h * (2 - h));
    for (int j = 0; j < m; ++j) {
      const double phi = 2 * std::numbers::pi * (j + 0.5) / m;
      sum += f(Vec3(r * std::cos(phi), r * std::sin(phi), z)) * 4 * t * t * t / n;
    }
  }
  return sum * 2 * std::numbers::pi / m;
}

template <class Distribution>
void checkDistribution(const Distribution& d) {
  // The facets cover the surface once.
  EXPECT_NEAR(overHemisphere([&](const Vec3& h) { return d.D(h) * h.z; }), 1, 2e-3);
  const auto width = [](const Vec3& h) { return std::log(1e-6 + h.x * h.x + h.y * h.y); };
  Rng rng(1);
  for (const float z : {0.02F, 0.3F, 0.9F, 1.F}) {
    const float r = std::sqrt(1 - z * z);
    const Vec3 wo(r * 0.6F, r * 0.8F, z);
    double share = 0, sampled = 0;
    constexpr int n = 100000;
    for (int i = 0; i < n; ++i) {
      const Vec3 h = d.sample(wo, {rng.uniform(), rng.uniform()});
      ASSERT_NEAR(glm::length(h), 1, 1e-5);
      ASSERT_GE(h.z, 0);
      const float cosH = glm::dot(wo, h);
      const Vec3 wi = 2 * cosH * h - wo;
      if (cosH <= 0) continue;
      sampled += width(h) / n;
      if (wi.z <= 1e-6F) continue;
      const float D = d.D(h), value = D * d.masking(wo, wi, h, cosH);
      share += value * wi.z / d.reflectedPdf(wo, h, cosH, D) / n;
      ASSERT_NEAR(value, D * d.masking(wi, wo, h, cosH), 1e-4F * value);
    }
    // Masked facets reflect nothing, no facet reflects twice.
    EXPECT_LE(share, 1.01) << z;
    // Samples are as wide as the density says, which is 4 cosH times that of the reflection.
    EXPECT_NEAR(sampled, overHemisphere([&](const Vec3& h) {
                  const float cosH = glm::dot(wo, h);
                  return cosH > 0 ? width(h) * 4 * cosH * d.reflectedPdf(wo, h, cosH, d.D(h)) : 0;
                }),
                0.03)
        << z;
  }
}

TEST(Microfacet, Blinn) {
  for (const float roughness : {1.F, 0.1F, 0.01F, 0.F}) checkDistribution(Blinn(roughness));
  checkDistribution(Blinn(0.5F, 0.05F));
}

TEST(Microfacet, TrowbridgeReitz) {
  for (const float alpha : {1.F, 0.3F, 0.05F}) checkDistribution(TrowbridgeReitz(alpha, alpha));
  checkDistribution(TrowbridgeReitz(0.1F, 0.5F));
}

TEST(Microfacet, Beckmann) {
  for (const float alpha : {1.F, 0.3F, 0.05F}) checkDistribution(Beckmann(alpha, alpha));
  checkDistribution(Beckmann(0.1F, 0.5F));
}

// Every visible normal is chosen with its share of the projected area, G1 D wo.h / cos o, which
// integrates to one; of the V-shaped grooves only visible normals are chosen, too.
template <class Distribution>
void checkVisible(const Distribution& d) {
  for (const float z : {0.05F, 0.5F, 1.F}) {
    const Vec3 wo(std::sqrt(1 - z * z), 0, z);
    EXPECT_NEAR(overHemisphere([&](const Vec3& h) {
                  const float cosH = glm::dot(wo, h);
                  return cosH > 0 ? 4 * cosH * d.reflectedPdf(wo, h, cosH, d.D(h)) : 0;
                }),
                1, 5e-3)
        << z;
    Rng rng(1);
    for (int i = 0; i < 10000; ++i)
      ASSERT_GE(glm::dot(wo, d.sample(wo, {rng.uniform(), rng.uniform()})), -1e-5F);
  }
}

TEST(Microfacet, VisibleNormalsAreAllThatIsSeen) {
  checkVisible(TrowbridgeReitz(0.2F, 0.6F));
  checkVisible(Beckmann(0.2F, 0.6F));
  checkVisible(Blinn(0.2F, 0.6F));
}

// What a smooth distribution of slopes hides is what Smith's integral over them says: G1 is
// cos o over the projected area of all facets that face wo (Heitz 2014, equation 23).
template <class Distribution>
void checkMasking(const Distribution& d) {
  for (const float z : {0.05F, 0.3F, 0.8F}) {
    const Vec3 wo(0.6F * std::sqrt(1 - z * z), 0.8F * std::sqrt(1 - z * z), z);
    const double facing =
        overHemisphere([&](const Vec3& h) { return std::max(0.F, glm::dot(wo, h)) * d.D(h); });
    // Of normal incidence nothing is hidden, and the joint masking is that of the other direction.
    const double G1 = d.masking(wo, {0, 0, 1}, {0, 0, 1}, 1) * 4 * z;
    EXPECT_NEAR(G1 * facing, z, 2e-3 * z) << z;
  }
}

TEST(Microfacet, MaskingLeavesWhatIsSeen) {
  checkMasking(TrowbridgeReitz(0.2F, 0.6F));
  checkMasking(Beckmann(0.2F, 0.6F));
  checkMasking(Beckmann(1, 1));
}

// A wide x axis spreads the normals along x.
TEST(Microfacet, AlphaXIsTheWidthInX) {
  const TrowbridgeReitz d(0.6F, 0.1F);
  const Blinn b(0.6F, 0.1F);
  const Vec3 x = glm::normalize(Vec3(0.5F, 0, 1)), y = glm::normalize(Vec3(0, 0.5F, 1));
  EXPECT_GT(d.D(x), d.D(y));
  EXPECT_GT(b.D(x), b.D(y));
}

TEST(Microfacet, AlphaGrowsWithRoughness) {
  float last = 0;
  for (float r = 0.001F; r < 1; r *= 1.1F) {
    EXPECT_GT(TrowbridgeReitz::alpha(r), last);
    last = TrowbridgeReitz::alpha(r);
  }
  EXPECT_EQ(TrowbridgeReitz::alpha(0), TrowbridgeReitz::alpha(0.001F));
}

}  // namespace
}  // namespace pbrt
