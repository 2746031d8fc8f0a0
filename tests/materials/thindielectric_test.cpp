#include "tests/materials/scattering.h"

namespace pbrt::test {
namespace {

constexpr std::uint8_t kMirrored = kReflection | kSpecular, kThrough = kTransmission | kSpecular;

TEST(ThinDielectric, PaneOfIndexTwo) {
  // Frontally F = 1/9, and 2 F / (1 + F) = 1/5.
  const Scattering pane("thindielectric", {number("eta", 2)});
  for (const Vec3 wo : {Vec3(0, 0, 1), Vec3(0, 0, -1)}) {
    EXPECT_NEAR(albedo(*pane.operator->(), wo, 1, kMirrored), 0.2, 1e-6);
    EXPECT_NEAR(albedo(*pane.operator->(), wo, 1, kThrough), 0.8, 1e-6);
  }
}

TEST(ThinDielectric, LightGoesStraightOnAndNoneIsLost) {
  const Scattering pane("thindielectric");
  for (const double angle : {5.0, 60.0, 89.0, 95.0, 170.0}) {
    const Vec3 wo = direction(angle);
    const auto s = pane->sample(wo, {0.5F, 0.5F}, kThrough);
    ASSERT_TRUE(s);
    EXPECT_EQ(s->wi, -wo);
    EXPECT_EQ(s->eta, 1);
    EXPECT_NEAR(
        albedo(*pane.operator->(), wo, 1, kMirrored) + albedo(*pane.operator->(), wo, 1, kThrough),
        1, 1e-5);
  }
}

}  // namespace
}  // namespace pbrt::test
