#include "tests/materials/scattering.h"

namespace pbrt::test {
namespace {

TEST(Translucent, BothSidesByTheirShares) {
  const Scattering leaf("translucent", {rgb("Kd", 0.4F, 0.4F, 0.4F), rgb("Ks", 0, 0, 0),
                                        rgb("reflect", 0.75F, 0, 1), rgb("transmit", 0.25F, 1, 0)});
  const Spectrum r = leaf->f({0, 0, 1}, direction(40)), t = leaf->f({0, 0, 1}, direction(140));
  EXPECT_NEAR(r.x, 0.3 / std::numbers::pi, 1e-6);
  EXPECT_NEAR(t.x, 0.1 / std::numbers::pi, 1e-6);
  EXPECT_EQ(r.y, 0);
  EXPECT_EQ(t.z, 0);
}

TEST(Translucent, GlossIsHalfOfGlass) {
  const Param roughness = number("roughness", 0.3F);
  const Scattering leaf("translucent", {rgb("Kd", 0, 0, 0), rgb("Ks", 1, 1, 1), roughness});
  const Scattering glass("glass", {roughness});
  for (const double o : {10.0, 60.0, 130.0})
    for (const double i : {20.0, 75.0, 140.0, 170.0}) {
      const float f = glass->f(direction(o), direction(i)).x;
      EXPECT_NEAR(leaf->f(direction(o), direction(i)).x, 0.5F * f, 1e-5F * f);
    }
}

// In pbrt-v1 and v2 light that goes through is what would be reflected, mirrored.
TEST(Translucent, BlinnIsAlikeOnBothSides) {
  const Scattering leaf("translucent", {text("distribution", "blinn")});
  const Vec3 wo = direction(30), up = direction(50, 2);
  EXPECT_FLOAT_EQ(leaf->f(wo, up).x, leaf->f(wo, {up.x, up.y, -up.z}).x);
  EXPECT_EQ(leaf->lobes(kAllLobes), 4);
}

}  // namespace
}  // namespace pbrt::test
