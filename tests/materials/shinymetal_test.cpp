#include "tests/materials/scattering.h"

namespace pbrt::test {
namespace {

constexpr std::uint8_t kMirrored = kReflection | kSpecular;

TEST(ShinyMetal, KrIsTheFrontalReflectance) {
  for (const float kr : {0.F, 0.3F, 0.9F}) {
    const Scattering metal("shinymetal", {rgb("Kr", kr, kr, kr)});
    EXPECT_NEAR(albedo(*metal.operator->(), {0, 0, 1}, 1, kMirrored), kr, 1e-5);
  }
}

TEST(ShinyMetal, GrazingLightIsAllReflected) {
  const Scattering metal("shinymetal", {rgb("Kr", 0.3F, 0.3F, 0.3F)});
  EXPECT_NEAR(albedo(*metal.operator->(), direction(89.999), 1, kMirrored), 1, 1e-3);
}

// The mirror's reflectance is the conductor formula with k = 0, long-hand.
TEST(ShinyMetal, MirrorIsTheConductorApproximation) {
  const Scattering metal("shinymetal", {rgb("Kr", 0.5F, 0.5F, 0.5F)});
  const double root = std::sqrt(0.5), eta = (1 + root) / (1 - root);
  for (const double angle : {0.0, 35.0, 75.0, 145.0}) {
    const double c = std::abs(std::cos(angle * std::numbers::pi / 180));
    const double a = eta * eta * c * c, b = 2 * eta * c;
    const double F =
        ((a - b + 1) / (a + b + 1) + (eta * eta - b + c * c) / (eta * eta + b + c * c));
    EXPECT_NEAR(albedo(*metal.operator->(), direction(angle), 1, kMirrored), F / 2, 1e-5);
  }
}

// Frontal light and facets: all but the facets' Fresnel term is that of any Blinn gloss.
TEST(ShinyMetal, KsScalesTheHighlight) {
  const Scattering metal("shinymetal", {rgb("Ks", 0.6F, 0.6F, 0.6F), number("roughness", 0.02F)});
  EXPECT_NEAR(metal->f({0, 0, 1}, {0, 0, 1}).x, 0.6 * (50 + 2) / (2 * std::numbers::pi) / 4, 1e-4);
}

}  // namespace
}  // namespace pbrt::test
