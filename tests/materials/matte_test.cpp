#include "tests/materials/scattering.h"

namespace pbrt::test {
namespace {

TEST(Matte, WhiteReflectsEverything) {
  const Scattering white("matte", {rgb("Kd", 1, 1, 1)});
  for (const double angle : {0.0, 60.0, 89.0, 130.0})
    EXPECT_NEAR(albedo(*white.operator->(), direction(angle), 1000), 1, 1e-5) << angle;
}

TEST(Matte, BlackScattersNothing) {
  EXPECT_EQ(Scattering("matte", {rgb("Kd", 0, 0, 0)})->lobes(kAllLobes), 0);
  EXPECT_EQ(Scattering("matte", {rgb("Kd", -1, -1, 0)})->lobes(kAllLobes), 0);
}

TEST(Matte, ReflectsNoLightThroughTheSurface) {
  const Scattering matte("matte");
  EXPECT_EQ(matte->f(direction(30), direction(120)), Spectrum(0));
  EXPECT_GT(matte->f(direction(30), direction(80)).x, 0);
}

// Oren and Nayar 1994, equation 30, with angles.
double orenNayar(double kd, double sigma, double thetaO, double phiO, double thetaI, double phiI) {
  const double s2 = sigma * sigma;
  const double A = 1 - 0.5 * s2 / (s2 + 0.33), B = 0.45 * s2 / (s2 + 0.09);
  return kd / std::numbers::pi *
         (A + B * std::max(0.0, std::cos(phiI - phiO)) * std::sin(std::max(thetaO, thetaI)) *
                  std::tan(std::min(thetaO, thetaI)));
}

TEST(Matte, SigmaIsOrenNayar) {
  for (const float sigma : {5.F, 20.F, 90.F}) {
    const Scattering rough("matte", {rgb("Kd", 0.8F, 0.4F, 0.2F), number("sigma", sigma)});
    Rng rng(1);
    for (int i = 0; i < 1000; ++i) {
      const double to = 85 * rng.uniform(), ti = 85 * rng.uniform();
      const double po = 6 * rng.uniform(), pi = 6 * rng.uniform();
      const double degree = std::numbers::pi / 180;
      const double f = orenNayar(0.8, sigma * degree, to * degree, po, ti * degree, pi);
      EXPECT_NEAR(rough->f(direction(to, po), direction(ti, pi)).x, f, 2e-6 + 1e-5 * f);
    }
  }
}

TEST(Matte, SigmaStopsAtNinetyDegrees) {
  const Scattering a("matte", {number("sigma", 90)}), b("matte", {number("sigma", 500)});
  EXPECT_EQ(a->f(direction(40), direction(50)), b->f(direction(40), direction(50)));
  const Scattering smooth("matte"), negative("matte", {number("sigma", -3)});
  EXPECT_EQ(smooth->f(direction(40), direction(50)), negative->f(direction(40), direction(50)));
}

TEST(Matte, BumpMapIsHandedOn) {
  EXPECT_EQ(make<Material>("matte")->bumpMap(), nullptr);
  const auto bumpy = make<Material>("matte", {number("bumpmap", 0.25F)});
  ASSERT_NE(bumpy->bumpMap(), nullptr);
  EXPECT_EQ((*bumpy->bumpMap())(flatSurface()), 0.25F);
  EXPECT_FALSE(bumpy->filters());
}

}  // namespace
}  // namespace pbrt::test
