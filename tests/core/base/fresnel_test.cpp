#include "core/base/fresnel.h"

#include <gtest/gtest.h>

#include <complex>

namespace pbrt {
namespace {

// Fresnel's equations in double, for any complex index.
double oracle(double cosI, std::complex<double> eta) {
  const std::complex<double> sinT = std::sqrt(1 - cosI * cosI) / eta;
  const std::complex<double> cosT = std::sqrt(1.0 - sinT * sinT);
  const auto rs = (cosI - eta * cosT) / (cosI + eta * cosT);
  const auto rp = (eta * cosI - cosT) / (eta * cosI + cosT);
  return (std::norm(rs) + std::norm(rp)) / 2;
}

TEST(Fresnel, DielectricsAgreeWithTheEquations) {
  for (const float eta : {1.F, 1.33F, 1.5F, 2.4F, 1000.F, 1 / 1.5F})
    for (float c = 0.001F; c <= 1; c += 0.001F)
      ASSERT_NEAR(fresnelDielectric(c, eta), oracle(c, static_cast<double>(eta)), 2e-5)
          << eta << " " << c;
}

TEST(Fresnel, EqualIndicesReflectNothing) {
  for (const float c : {1.F, 0.5F, 1e-3F, 1e-6F}) {
    EXPECT_EQ(fresnelDielectric(c, 1), 0);
    EXPECT_EQ(fresnelDielectric(-c, 1), 0);
  }
}

// Stokes: the reflectance of a boundary is the same along a ray and along its refracted ray.
TEST(Fresnel, TheOtherSideReflectsTheSameShare) {
  for (float c = 0.1F; c <= 1; c += 0.01F) {
    const float cosT = std::sqrt(1 - (1 - c * c) / (1.5F * 1.5F));
    EXPECT_NEAR(fresnelDielectric(c, 1.5F), fresnelDielectric(-cosT, 1.5F), 1e-5);
  }
}

TEST(Fresnel, GrazingLightIsAllReflected) {
  EXPECT_NEAR(fresnelDielectric(1e-7F, 1.5F), 1, 1e-5);
  EXPECT_EQ(fresnelDielectric(0.5F, 1 / 1.5F), 1);
}

TEST(Fresnel, ConductorsAgreeWithTheEquations) {
  for (const float eta : {0.05F, 0.2F, 1.F, 1.5F, 7.F})
    for (const float k : {0.F, 0.5F, 3.F, 9.F})
      for (float c = 0.01F; c <= 1; c += 0.01F)
        ASSERT_NEAR(fresnelConductor(c, eta, k),
                    oracle(c, {static_cast<double>(eta), static_cast<double>(k)}), 2e-5)
            << eta << " " << k << " " << c;
}

// The error of the approximation falls with eta^2 + k^2.
TEST(Fresnel, TheApproximationComesCloseToTheEquations) {
  const auto approximate = [](float c, float eta, float k) {
    return fresnelConductorApproximate(c, Spectrum(eta), Spectrum(k)).x;
  };
  for (float c = 0.01F; c <= 1; c += 0.01F) {
    EXPECT_NEAR(approximate(c, 1.5F, 7), oracle(c, {1.5, 7}), 0.005);
    EXPECT_NEAR(approximate(c, 0.2F, 3), oracle(c, {0.2, 3}), 0.02);
  }
  EXPECT_NEAR(approximate(1, 0.2F, 3), oracle(1, {0.2, 3}), 1e-6);
}

// The integral in closed form (Duntley 1942, equation 36).
double diffuse(double n) {
  const double n2 = n * n, n4 = n2 * n2;
  return 0.5 + (n - 1) * (3 * n + 1) / (6 * (n + 1) * (n + 1)) +
         n2 * (n2 - 1) * (n2 - 1) / std::pow(n2 + 1, 3) * std::log((n - 1) / (n + 1)) -
         2 * n * n2 * (n2 + 2 * n - 1) / ((n2 + 1) * (n4 - 1)) +
         8 * n4 * (n4 + 1) / ((n2 + 1) * (n4 - 1) * (n4 - 1)) * std::log(n);
}

TEST(Fresnel, DiffuseLight) {
  for (const double n : {1.1, 1.33, 1.5, 2.4, 10.0}) {
    EXPECT_NEAR(fresnelDiffuse(static_cast<float>(n)), diffuse(n), 3e-5) << n;
    EXPECT_NEAR(fresnelDiffuse(static_cast<float>(1 / n)), 1 - (1 - diffuse(n)) / (n * n), 3e-5);
  }
  EXPECT_EQ(fresnelDiffuse(1), 0);
}

// A pane, bounce by bounce.
TEST(Fresnel, PaneSumsAllItsReflections) {
  for (const float c : {1.F, 0.4F, -0.1F}) {
    const double F = fresnelDielectric(std::abs(c), 1.5F);
    double sum = F, inside = (1 - F) * F;
    for (int i = 0; i < 1000; ++i, inside *= F * F) sum += inside * (1 - F);
    EXPECT_NEAR(PaneFresnel{1.5F}(c), sum, 1e-6);
  }
}

}  // namespace
}  // namespace pbrt
