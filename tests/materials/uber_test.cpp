#include "tests/materials/scattering.h"

namespace pbrt::test {
namespace {

constexpr std::uint8_t kMirrored = kReflection | kSpecular, kThrough = kTransmission | kSpecular;

TEST(Uber, OnlyWhatIsNotBlackIsThere) {
  EXPECT_EQ(Scattering("uber")->lobes(kAllLobes), 2);
  EXPECT_EQ(Scattering("uber", {rgb("Kr", 1, 1, 1)})->lobes(kMirrored), 1);
  EXPECT_EQ(Scattering("uber", {rgb("Kt", 1, 1, 1)})->lobes(kThrough), 1);
  EXPECT_EQ(Scattering("uber", {rgb("Kt", 1, 1, 1), rgb("opacity", 0, 0, 0)})->lobes(kAllLobes), 1);
}

TEST(Uber, WhatIsNotOpaqueIsSeenThrough) {
  const Scattering uber(
      "uber", {rgb("opacity", 0.25F, 1, 0), rgb("Kd", 0.5F, 0.5F, 0.5F), rgb("Ks", 0, 0, 0)});
  const Vec3 wo = direction(50);
  const auto s = uber->sample(wo, {0.5F, 0.5F}, kThrough);
  ASSERT_TRUE(s);
  EXPECT_NEAR(glm::length(s->wi + wo), 0, 1e-6);
  const Spectrum through = s->f * std::abs(s->wi.z) / s->pdf;
  EXPECT_NEAR(through.x, 0.75, 1e-5);
  EXPECT_EQ(through.y, 0);
  EXPECT_NEAR(through.z, 1, 1e-5);
  EXPECT_EQ(s->eta, 1);
  const Spectrum f = uber->f({0, 0, 1}, wo);
  EXPECT_NEAR(f.x, 0.25 * 0.5 / std::numbers::pi, 1e-6);
  EXPECT_EQ(f.z, 0);
}

TEST(Uber, KtRefractsAndKrMirrorsAsGlassDoes) {
  const Scattering uber("uber", {rgb("Kd", 0, 0, 0), rgb("Ks", 0, 0, 0), rgb("Kr", 1, 1, 1),
                                 rgb("Kt", 1, 1, 1), number("index", 1.3F)});
  const Scattering glass("glass", {number("index", 1.3F)});
  for (const double angle : {20.0, 80.0, 160.0})
    for (const std::uint8_t lobe : {kMirrored, kThrough}) {
      const auto a = uber->sample(direction(angle), {0.5F, 0.5F}, lobe);
      const auto b = glass->sample(direction(angle), {0.5F, 0.5F}, lobe);
      ASSERT_TRUE(a && b);
      EXPECT_EQ(a->wi, b->wi);
      EXPECT_EQ(a->f, b->f);
    }
}

TEST(Uber, GlossIsThatOfPlastic) {
  for (const char* distribution : {"trowbridgereitz", "blinn"}) {
    const ParamList set = {rgb("Kd", 0.1F, 0.2F, 0.3F), rgb("Ks", 0.4F, 0.5F, 0.6F),
                           number("roughness", 0.2F), text("distribution", distribution)};
    const Scattering uber("uber", set), plastic("plastic", set);
    for (const double angle : {0.0, 30.0, 80.0}) {
      const Spectrum f = uber->f(direction(angle), direction(20)),
                     g = plastic->f(direction(angle), direction(20));
      EXPECT_NEAR(f.x, g.x, 1e-5 * g.x) << distribution << angle;
    }
  }
}

}  // namespace
}  // namespace pbrt::test
