#include "core/api/lobes.h"

#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "core/base/warp.h"

namespace pbrt {
namespace {

double reflected(const Bxdf& lobe, const Vec3& wo) {
  Rng rng(1);
  double sum = 0;
  constexpr int n = 200000;
  for (int i = 0; i < n; ++i)
    if (const auto s = lobe.sample(wo, {rng.uniform(), rng.uniform()}))
      sum += s->f.x * std::abs(s->wi.z) / s->pdf / n;
  return sum;
}

// The model's albedo in closed form. With theta the angle of wo, the integral over theta_i of
// sin^2 cos / cos(beta) has an antiderivative on either side of theta:
//   A + B (2 / pi) sin(theta) ((theta - sin(theta) cos(theta)) / 2
//                              + (1 - sin^3(theta)) tan(theta) / (3 sin(theta)))
// where beta is theta_i below theta, and theta above.
TEST(Lobes, OrenNayarAlbedo) {
  for (const double sigma : {0.1, 0.5, 1.2})
    for (const double theta : {0.2, 0.8, 1.4}) {
      const double s2 = sigma * sigma, s = std::sin(theta), c = std::cos(theta);
      const double A = 1 - 0.5 * s2 / (s2 + 0.33), B = 0.45 * s2 / (s2 + 0.09);
      const double inner = s * (theta - s * c) / 2 + s * (1 - s * s * s) / (3 * c);
      const OrenNayar lobe(Spectrum(1), static_cast<float>(sigma));
      EXPECT_NEAR(reflected(lobe, Vec3(s, 0, c)), A + B * 2 / std::numbers::pi * inner, 2e-3)
          << sigma << " " << theta;
    }
}

TEST(Lobes, OrenNayarOfNoRoughnessIsLambertian) {
  const OrenNayar rough(Spectrum(0.5F), 0);
  const Lambertian smooth(Spectrum(0.5F));
  const Vec3 a = glm::normalize(Vec3(1, 2, 3)), b = glm::normalize(Vec3(3, 1, 0.1F));
  EXPECT_NEAR(rough.f(a, b).x, smooth.f(a, b).x, 1e-7);
}

// Facets that reflect everything lose only what is masked; sharp ones nearly nothing.
TEST(Lobes, SharpFacetsAreAMirror) {
  const MicrofacetReflection<TrowbridgeReitz, NoFresnel> ggx(Spectrum(1), {0.01F, 0.01F}, {});
  const MicrofacetReflection<Blinn, NoFresnel> blinn(Spectrum(1), Blinn(1e-4F), {});
  for (const Vec3 wo : {Vec3(0, 0, 1), Vec3(0.6F, 0, 0.8F), Vec3(0.8F, 0, -0.6F)}) {
    EXPECT_NEAR(reflected(ggx, wo), 1, 5e-3);
    EXPECT_NEAR(reflected(blinn, wo), 1, 2e-2);
    const auto s = ggx.sample(wo, {0.3F, 0.4F});
    ASSERT_TRUE(s);
    EXPECT_NEAR(glm::length(s->wi - Vec3(-wo.x, -wo.y, wo.z)), 0, 0.1);
  }
}

TEST(Lobes, BothSidesOfTheSurfaceAreAlike) {
  const MicrofacetReflection<TrowbridgeReitz, NoFresnel> ggx(Spectrum(1), {0.1F, 0.4F}, {});
  const Vec3 a = glm::normalize(Vec3(1, 2, 3)), b = glm::normalize(Vec3(-2, -1, 3));
  EXPECT_FLOAT_EQ(ggx.f(a, b).x, ggx.f(-a, -b).x);
  EXPECT_FLOAT_EQ(ggx.pdf(a, b), ggx.pdf(-a, -b));
  EXPECT_EQ(ggx.pdf(a, -b), 0);
}

}  // namespace
}  // namespace pbrt
