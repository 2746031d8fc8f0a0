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

// The error of the approximation falls with eta^2 + k^2.
TEST(Fresnel, ConductorsComeCloseToTheEquations) {
  for (float c = 0.01F; c <= 1; c += 0.01F) {
    EXPECT_NEAR(fresnelConductor(c, Spectrum(1.5F), Spectrum(7)).x, oracle(c, {1.5, 7}), 0.005);
    EXPECT_NEAR(fresnelConductor(c, Spectrum(0.2F), Spectrum(3)).x, oracle(c, {0.2, 3}), 0.02);
  }
  EXPECT_NEAR(fresnelConductor(1, Spectrum(0.2F), Spectrum(3)).y, oracle(1, {0.2, 3}), 1e-6);
}

}  // namespace
}  // namespace pbrt
