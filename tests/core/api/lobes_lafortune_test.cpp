#include "core/api/lobes_lafortune.h"

#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "core/base/warp.h"

namespace pbrt {
namespace {

constexpr LafortuneFit kFit{Spectrum(0.1F),
                            {{{{-1, -1.05F, -0.9F}, {0.8F, 0.9F, 1}, {10, 40, 3}},
                              {{-0.5F, -0.6F, -0.7F}, {0.3F, 0.2F, 0.1F}, {2, 3, 4}},
                              {{0.9F, 0.8F, 0.7F}, {-0.2F, 0.5F, 0.6F}, {20, 5, 7}}}}};

Vec3 random(Rng& rng) {
  return uniformSphere({rng.uniform(), rng.uniform()});
}

// Equation 8 of Lafortune et al. 1997 with the dot product written out, in double.
double lobe(const GeneralizedCosine& c, int colour, const DVec3& o, const DVec3& i) {
  const double dot = static_cast<double>(c.xy[colour]) * o.x * i.x +
                     static_cast<double>(c.xy[colour]) * o.y * i.y +
                     static_cast<double>(c.z[colour]) * o.z * i.z;
  return dot > 0 ? std::pow(dot, c.exponent[colour]) : 0;
}

// By midpoints, over the upper hemisphere.
double albedo(const LafortuneFit& fit, int colour, double cosTheta) {
  constexpr int n = 300;
  const DVec3 o(std::sqrt(1 - cosTheta * cosTheta), 0, cosTheta);
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double z = (i + 0.5) / n, r = std::sqrt(1 - z * z),
                   phi = 2 * std::numbers::pi * (j + 0.5) / n;
      for (const GeneralizedCosine& c : fit.lobes)
        sum += lobe(c, colour, o, {r * std::cos(phi), r * std::sin(phi), z}) * z;
    }
  return sum * 2 * std::numbers::pi / (n * n);
}

TEST(Lafortune, IsThePapersWhereItMakesNoEnergy) {
  const LafortuneModel model(kFit);
  Rng rng(1);
  int lit = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 wo = random(rng), wi = random(rng);
    for (int l = 0; l < LafortuneFit::kLobes; ++l) {
      const Spectrum f = LafortuneLobe(model, l).f(wo, wi);
      for (int colour = 0; colour < 3; ++colour) {
        const double expected = sameHemisphere(wo, wi) ? lobe(kFit.lobes[l], colour, wo, wi) *
                                                             std::min(model.kept(wo.z)[colour],
                                                                      model.kept(wi.z)[colour])
                                                       : 0;
        ASSERT_NEAR(f[colour], expected, 1e-6 + 1e-4 * expected);
        lit += expected > 1e-3;
      }
    }
  }
  EXPECT_GT(lit, 1000);
}

// k is 1 where the fit keeps to the energy that comes, and just what it must be elsewhere.
TEST(Lafortune, OnlyEnergyThatIsMadeIsTakenBack) {
  LafortuneFit bright = kFit;
  bright.lobes[0].xy *= 1.1F;
  for (const LafortuneFit& fit : {kFit, bright}) {
    const LafortuneModel model(fit);
    for (const float c : {0.F, 0.125F, 0.5F, 1.F})
      for (int colour = 0; colour < 3; ++colour) {
        const double most = 0.9 / albedo(fit, colour, c);
        EXPECT_NEAR(model.kept(c)[colour], std::min(1.0, most), 0.01) << c;
        EXPECT_EQ(model.kept(c)[colour], model.kept(-c)[colour]);
      }
  }
  EXPECT_LT(LafortuneModel(bright).kept(0.125F).y, 0.9F);
}

TEST(Lafortune, LobesKnowTheirAlbedo) {
  const LafortuneModel model(kFit);
  for (const float c : {0.1F, 0.6F, 1.F}) {
    double sum = 0, expected = 0;
    for (int l = 0; l < LafortuneFit::kLobes; ++l) sum += model.albedo(l, c);
    for (int colour = 0; colour < 3; ++colour) {
      Spectrum one(0);
      one[colour] = 1;
      expected += luminance(one) * albedo(kFit, colour, c);
    }
    EXPECT_NEAR(sum, expected, 0.02 * expected) << c;
  }
}

// Where q is below the surface, what is above is but the flank of the lobe. A lobe whose weight
// were 0 there would never be sampled.
TEST(Lafortune, LobesBelowTheSurfaceHaveWeight) {
  for (const float exponent : {3.F, 9.F, 25.F}) {
    LafortuneFit fit;
    fit.lobes[0] = {Spectrum(-1.1F), Spectrum(-1.4F), Spectrum(exponent)};
    const LafortuneModel model(fit);
    for (const int j : {1, 16, 32, 48, 60, 62}) {
      const float c = static_cast<float>(j) / 64;  // where the model has it
      const double expected = albedo(fit, 0, c);
      const float weight = LafortuneLobe(model, 0).weight({safeSqrt(1 - c * c), 0, c});
      EXPECT_GT(weight, 0) << c;
      if (expected > 1e-9) {
        EXPECT_NEAR(weight, expected, 0.15 * expected) << c;
      }
    }
  }
}

}  // namespace
}  // namespace pbrt
