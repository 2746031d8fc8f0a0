#include "tests/materials/scattering.h"

namespace pbrt::test {
namespace {

const Param kAlpha = flag("remaproughness", false);

TEST(CoatedConductor, SmoothLayersAreOneMirror) {
  const Scattering coated("coatedconductor");
  EXPECT_EQ(coated->lobes(kAllLobes), 1);
  EXPECT_EQ(coated->lobes(kReflection | kSpecular), 1);
}

// Frontally, by hand: F = 0.04, the conductor's C is that of m = (eta + i k) / 1.5.
TEST(CoatedConductor, FrontalReflectance) {
  const Scattering coated("coatedconductor",
                          {rgb("conductor.eta", 0.3F, 0.3F, 0.3F), rgb("conductor.k", 3, 3, 3)});
  const double C = (0.8 * 0.8 + 4) / (1.2 * 1.2 + 4);
  EXPECT_NEAR(albedo(*coated.operator->(), {0, 0, 1}, 1), 0.04 + 0.96 * 0.96 * C / (1 - 0.04 * C),
              1e-5);
}

TEST(CoatedConductor, ABrightBaseLosesLittle) {
  for (const float alpha : {0.F, 0.02F, 0.05F}) {
    const Scattering coated("coatedconductor", {rgb("reflectance", 1, 1, 1), kAlpha,
                                                number("conductor.roughness", alpha)});
    EXPECT_NEAR(albedo(*coated.operator->(), direction(30), 40000), 1, 0.05) << alpha;
  }
}

TEST(CoatedConductor, ACoatOfAirIsNone) {
  const Scattering coated(
      "coatedconductor", {number("interface.eta", 1), kAlpha, number("conductor.roughness", 0.3F)});
  const Scattering metal("metal", {number("roughness", 0.3F), kAlpha});
  const Spectrum f = coated->f(direction(20), direction(60)),
                 g = metal->f(direction(20), direction(60));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(f[c], g[c], 1e-4F * g[c]);
}

TEST(CoatedConductor, ARoughCoatBlursTheMirrorBelow) {
  const Scattering coated("coatedconductor", {number("interface.roughness", 0.3F), kAlpha});
  EXPECT_EQ(coated->lobes(kReflection | kGlossy), 2);
  EXPECT_EQ(coated->lobes(kReflection | kSpecular), 0);
}

}  // namespace
}  // namespace pbrt::test
