#include "tests/materials/scattering.h"

namespace pbrt::test {
namespace {

constexpr std::uint8_t kMirrored = kReflection | kSpecular, kGloss = kReflection | kGlossy;
const Param kAlpha = flag("remaproughness", false);

// |(1 - m) / (1 + m)|^2, m = eta + i k.
double frontal(double eta, double k) {
  return ((eta - 1) * (eta - 1) + k * k) / ((eta + 1) * (eta + 1) + k * k);
}

TEST(Metal, MirrorsByItsIndex) {
  const Scattering metal("metal",
                         {rgb("eta", 0.2F, 1, 2), rgb("k", 3, 4, 0), number("roughness", 0)});
  ASSERT_EQ(metal->lobes(kMirrored), 1);
  const auto s = metal->sample({0, 0, 1}, {0.5F, 0.5F});
  ASSERT_TRUE(s);
  EXPECT_NEAR(s->f.x, frontal(0.2, 3), 1e-5);
  EXPECT_NEAR(s->f.y, frontal(1, 4), 1e-5);
  EXPECT_NEAR(s->f.z, frontal(2, 0), 1e-5);
}

TEST(Metal, IsRoughCopperUnlessSaidOtherwise) {
  const Scattering metal("metal");
  EXPECT_EQ(metal->lobes(kGloss), 1);
  const Spectrum f = metal->f({0, 0, 1}, {0, 0, 1});
  EXPECT_GT(f.x, 1.3F * f.y);
  EXPECT_GT(f.y, 1.1F * f.z);
}

TEST(Metal, KnowsMetalsByName) {
  const auto named = [](const std::string& parameter, const std::string& name) {
    return Param{ParamType::spectrum, parameter, {}, {}, std::vector<std::string>{name}};
  };
  const Scattering copper("metal"),
      same("metal", {named("eta", "metal-Cu-eta"), named("k", "metal-Cu-k")});
  EXPECT_EQ(copper->f({0, 0, 1}, {0, 0, 1}), same->f({0, 0, 1}, {0, 0, 1}));
  // Silver is bright and nearly white.
  const Scattering silver(
      "metal", {named("eta", "metal-Ag-eta"), named("k", "metal-Ag-k"), number("roughness", 0)});
  const auto s = silver->sample({0, 0, 1}, {0.5F, 0.5F});
  ASSERT_TRUE(s);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(s->f[c], 0.95, 0.05);
}

TEST(Metal, ReflectanceIsThatSeenFrontally) {
  const Scattering metal("metal", {rgb("reflectance", 0.2F, 0.9F, 1), number("roughness", 0)});
  const auto s = metal->sample({0, 0, 1}, {0.5F, 0.5F});
  ASSERT_TRUE(s);
  EXPECT_NEAR(s->f.x, 0.2, 1e-5);
  EXPECT_NEAR(s->f.y, 0.9, 1e-5);
  EXPECT_NEAR(s->f.z, 1, 2e-4);
}

// The peak of the highlight is F / (4 pi alphaX alphaY).
TEST(Metal, RoughnessOfEachAxis) {
  const auto peak = [](ParamList set) {
    for (const Param& p : {kAlpha, rgb("eta", 0.2F, 1, 2), rgb("k", 3, 4, 1)}) set.push_back(p);
    return Scattering("metal", set)->f({0, 0, 1}, {0, 0, 1}).x;
  };
  const float one = peak({number("roughness", 0.2F)});
  EXPECT_NEAR(one, frontal(0.2, 3) / (4 * std::numbers::pi * 0.04), 1e-3);
  EXPECT_NEAR(peak({number("roughness", 0.2F), number("uroughness", 0.4F)}), one / 2, 1e-3);
  EXPECT_NEAR(peak({number("uroughness", 0.1F), number("vroughness", 0.4F)}), one, 1e-3);
  // Wide along the tangent.
  const Scattering brushed("metal",
                           {number("uroughness", 0.6F), number("vroughness", 0.1F), kAlpha});
  EXPECT_GT(brushed->f({0, 0, 1}, {0.6F, 0, 0.8F}).x, 3 * brushed->f({0, 0, 1}, {0, 0.6F, 0.8F}).x);
}

TEST(Metal, RefusesTwoWaysToSayTheSame) {
  EXPECT_THROW(make<Material>("metal", {rgb("reflectance", 1, 1, 1), rgb("k", 1, 1, 1)}), Error);
  EXPECT_NO_THROW(make<Material>("metal", {rgb("eta", 1, 1, 1), rgb("k", 1, 1, 1)}));
}

}  // namespace
}  // namespace pbrt::test
