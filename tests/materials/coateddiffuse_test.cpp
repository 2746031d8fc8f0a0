#include "tests/materials/scattering.h"

namespace pbrt::test {
namespace {

TEST(CoatedDiffuse, WhiteUnderASmoothCoatIsWhite) {
  const Scattering coated("coateddiffuse", {rgb("reflectance", 1, 1, 1)});
  EXPECT_EQ(coated->lobes(kReflection | kSpecular), 1);
  for (const double angle : {0.0, 50.0, 85.0, 130.0})
    EXPECT_NEAR(albedo(*coated.operator->(), direction(angle), 40000), 1, 0.01) << angle;
}

TEST(CoatedDiffuse, ACoatOfAirIsNone) {
  const Scattering coated("coateddiffuse", {number("eta", 1), rgb("reflectance", 0.3F, 0.3F, 0.3F),
                                            number("roughness", 0.4F)});
  EXPECT_NEAR(coated->f(direction(30), direction(70)).x, 0.3 / std::numbers::pi, 1e-5);
  EXPECT_NEAR(albedo(*coated.operator->(), direction(60), 20000), 0.3, 2e-3);
}

// Colour gets more saturated, as what is reflected inside meets the base again.
TEST(CoatedDiffuse, CoatsSaturate) {
  const Spectrum f =
      Scattering("coateddiffuse", {rgb("reflectance", 0.8F, 0.4F, 0.1F)})->f({0, 0, 1}, {0, 0, 1});
  EXPECT_GT(f.x / f.y, 2.5F);
  EXPECT_GT(f.y / f.z, 4.5F);
}

TEST(CoatedDiffuse, TheBaseChangesSmoothlyWithRoughness) {
  float last = 0;
  for (const float alpha : {0.F, 1e-4F, 2e-3F, 0.01F, 0.02F}) {
    const Scattering coated("coateddiffuse",
                            {number("roughness", alpha), flag("remaproughness", false)});
    const float f = coated->f(direction(10), direction(80), kReflection | kDiffuse).x;
    if (last > 0) {
      EXPECT_NEAR(f, last, 0.05F * last) << alpha;
    }
    last = f;
  }
}

TEST(CoatedDiffuse, RefusesACoatThinnerThanAir) {
  EXPECT_THROW(make<Material>("coateddiffuse", {number("eta", 0.9F)}), Error);
}

}  // namespace
}  // namespace pbrt::test
