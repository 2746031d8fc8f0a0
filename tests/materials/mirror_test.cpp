#include "tests/materials/scattering.h"

namespace pbrt::test {
namespace {

TEST(Mirror, ReflectsTheShareKrAtEveryAngle) {
  for (const float kr : {1.F, 0.4F}) {
    const Scattering mirror("mirror", {rgb("Kr", kr, kr, kr)});
    for (const double angle : {0.0, 45.0, 89.9, 170.0})
      EXPECT_NEAR(albedo(*mirror.operator->(), direction(angle), 1), kr, 1e-5) << angle;
  }
}

TEST(Mirror, AngleInIsAngleOut) {
  const auto s = Scattering("mirror")->sample(direction(40, 0.3), {0.5F, 0.5F});
  ASSERT_TRUE(s);
  EXPECT_NEAR(glm::length(s->wi - direction(40, 0.3 + std::numbers::pi)), 0, 1e-6);
  EXPECT_EQ(s->flags, kReflection | kSpecular);
  EXPECT_EQ(s->pdf, 1);
}

TEST(Mirror, HasNoDensity) {
  const Scattering mirror("mirror");
  EXPECT_EQ(mirror->f(direction(40, 0), direction(-40, 0)), Spectrum(0));
  EXPECT_EQ(mirror->pdf(direction(40, 0), direction(-40, 0)), 0);
  EXPECT_FALSE(mirror->has(kDiffuse | kGlossy));
  EXPECT_FALSE(mirror->sample(direction(40), {0.5F, 0.5F}, kReflection | kDiffuse));
}

TEST(Mirror, BlackScattersNothing) {
  EXPECT_EQ(Scattering("mirror", {rgb("Kr", 0, 0, 0)})->lobes(kAllLobes), 0);
}

}  // namespace
}  // namespace pbrt::test
