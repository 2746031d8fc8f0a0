#include "core/api/lobes.h"
#include "tests/materials/scattering.h"

namespace pbrt::test {
namespace {

constexpr std::uint8_t kMirrored = kReflection | kSpecular, kRefracted = kTransmission | kSpecular;

TEST(Glass, LightIsEitherReflectedOrTransmitted) {
  for (const float index : {1.F, 1.0000001F, 1.1F, 1.5F, 2.4F, 1000.F, 0.5F}) {
    const Scattering glass("glass", {number("index", index)});
    for (const double angle : {0.0, 20.0, 41.0, 60.0, 89.0, 91.0, 100.0, 139.0, 180.0}) {
      const double r = albedo(*glass.operator->(), direction(angle), 1, kMirrored);
      const double t = albedo(*glass.operator->(), direction(angle), 1, kRefracted);
      EXPECT_NEAR(r + t, 1, 2e-5) << index << " at " << angle;
    }
  }
}

TEST(Glass, FrontalReflectance) {
  for (const float n : {1.F, 1.5F, 2.4F}) {
    const Scattering glass("glass", {number("eta", n)});
    EXPECT_NEAR(albedo(*glass.operator->(), {0, 0, 1}, 1, kMirrored), sqr((n - 1) / (n + 1)), 1e-6);
    EXPECT_NEAR(albedo(*glass.operator->(), {0, 0, -1}, 1, kMirrored), sqr((n - 1) / (n + 1)),
                1e-6);
  }
}

TEST(Glass, NothingButTheSurfaceOfAirInAir) {
  const Scattering air("glass", {number("index", 1)});
  for (const double angle : {0.0, 70.0, 89.99}) {
    EXPECT_NEAR(albedo(*air.operator->(), direction(angle), 1, kMirrored), 0, 1e-6) << angle;
    const auto s = air->sample(direction(angle), {0, 0}, kRefracted);
    ASSERT_TRUE(s);
    EXPECT_NEAR(glm::length(s->wi + direction(angle)), 0, 2e-6);
  }
}

TEST(Glass, RefractsBySnellAndBack) {
  const Scattering glass("glass", {number("index", 1.5F)});
  for (const double angle : {1.0, 30.0, 80.0}) {
    const Vec3 wo = direction(angle);
    const auto in = glass->sample(wo, {0.5F, 0.5F}, kRefracted);
    ASSERT_TRUE(in);
    EXPECT_NEAR(std::hypot(in->wi.x, in->wi.y) * 1.5, std::hypot(wo.x, wo.y), 1e-6);
    EXPECT_NEAR(in->eta, 1.5, 1e-6);
    const auto out = glass->sample(in->wi, {0.5F, 0.5F}, kRefracted);
    ASSERT_TRUE(out);
    EXPECT_NEAR(glm::length(out->wi - wo), 0, 5e-6);
    EXPECT_NEAR(out->eta * in->eta, 1, 1e-6);
    // The squared indices of both ways cancel: what is left is (1 - F)^2.
    const double F = albedo(*glass.operator->(), wo, 1, kMirrored);
    EXPECT_NEAR(in->f.x * std::abs(in->wi.z) * out->f.x * std::abs(out->wi.z), sqr(1 - F), 1e-5);
  }
}

TEST(Glass, TotalReflectionStartsAtTheCriticalAngle) {
  const Scattering glass("glass", {number("index", 1.5F)});
  const double critical = std::asin(1 / 1.5) * 180 / std::numbers::pi;
  EXPECT_TRUE(glass->sample(-direction(critical - 0.01), {0, 0}, kRefracted));
  EXPECT_FALSE(glass->sample(-direction(critical + 0.01), {0, 0}, kRefracted));
  EXPECT_NEAR(albedo(*glass.operator->(), -direction(critical + 0.01), 1, kMirrored), 1, 1e-5);
}

TEST(Glass, BlackPartsAreLeftOut) {
  EXPECT_EQ(Scattering("glass", {rgb("Kr", 0, 0, 0)})->lobes(kAllLobes), 1);
  EXPECT_EQ(Scattering("glass", {rgb("Kt", 0, 0, 0)})->lobes(kRefracted), 0);
}

TEST(Glass, KnowsGlassesByName) {
  const Scattering bk7(
      "glass", {{ParamType::spectrum, "eta", {}, {}, std::vector<std::string>{"glass-BK7"}}});
  const auto s = bk7->sample(direction(40), {0.5F, 0.5F}, kRefracted);
  ASSERT_TRUE(s);
  EXPECT_NEAR(s->eta, 1.5168, 1e-4);  // Schott's n_D
}

TEST(Glass, RefusesWhatItCannotBe) {
  EXPECT_THROW(make<Material>("glass", {number("index", 0)}), Error);
  EXPECT_THROW(make<Material>("glass", {number("eta", -1.5F)}), Error);
  EXPECT_THROW(make<Material>("glass", {text("remapping", "v5")}), Error);
}

constexpr std::uint8_t kFrosted = kReflection | kTransmission | kGlossy;
const Param kAlpha = flag("remaproughness", false);

TEST(Glass, NoRoughnessIsClear) {
  for (const ParamList& none :
       {ParamList{}, ParamList{number("roughness", 0)},
        ParamList{number("roughness", 1e-4F), kAlpha},
        ParamList{number("uroughness", 0), number("vroughness", 0), text("remapping", "v4")},
        // Facets of what has the index of air bend nothing.
        ParamList{number("roughness", 0.5F), number("index", 1)}})
    EXPECT_EQ(Scattering("glass", none)->lobes(kSpecular | kReflection | kTransmission), 2);
  for (const ParamList& rough :
       {ParamList{number("roughness", 0.1F)}, ParamList{number("vroughness", 0.1F)}})
    EXPECT_EQ(Scattering("glass", rough)->lobes(kFrosted), 2);
}

// Sharp facets mask little: nothing is lost, and the shares are those of clear glass.
TEST(Glass, SlightRoughnessLosesLittle) {
  const Scattering glass("glass", {number("roughness", 0.03F), kAlpha});
  for (const double angle : {0.0, 40.0, 65.0, 115.0, 155.0, 180.0}) {
    const Vec3 wo = direction(angle);
    const double r = albedo(*glass.operator->(), wo, 40000, kReflection | kGlossy);
    const double t = albedo(*glass.operator->(), wo, 40000, kTransmission | kGlossy);
    EXPECT_NEAR(r + t, 1, 0.01) << angle;
    EXPECT_NEAR(r, fresnelDielectric(wo.z, 1.5F), 0.02) << angle;
  }
}

TEST(Glass, RoughnessIsMappedAsItsGenerationDoes) {
  const auto peak = [](const ParamList& set) {
    return Scattering("glass", set)->f({0, 0, 1}, {0, 0, 1}).x;
  };
  // D(z) G F / 4 = 0.04 / (4 pi alpha^2)
  const auto expected = [](double alpha) { return 0.01 / (std::numbers::pi * alpha * alpha); };
  const Param roughness = number("roughness", 0.25F);
  EXPECT_NEAR(peak({roughness, kAlpha}), expected(0.25), 1e-4);
  EXPECT_NEAR(peak({roughness, text("remapping", "v4")}), expected(0.5), 1e-4);
  EXPECT_NEAR(peak({roughness}), expected(TrowbridgeReitz::alpha(0.25F)), 1e-4);
}

}  // namespace
}  // namespace pbrt::test
