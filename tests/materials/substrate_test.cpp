#include "tests/materials/scattering.h"

namespace pbrt::test {
namespace {

TEST(Substrate, SaysWhatIsDiffuseAndWhatIsGloss) {
  // Frontally, h = z: 28 / (23 pi) Kd (1 - Ks) (1 - 2^-5)^2 + Ks / (4 pi alpha^2).
  const Scattering substrate(
      "substrate", {rgb("Kd", 0.3F, 0, 0.3F), rgb("Ks", 0.1F, 0.1F, 0), number("uroughness", 0.2F),
                    number("vroughness", 0.4F), flag("remaproughness", false)});
  const Spectrum f = substrate->f({0, 0, 1}, {0, 0, 1});
  const double base = 28 * 0.3 / (23 * std::numbers::pi) * std::pow(31.0 / 32, 2);
  const double gloss = 0.1 / (4 * std::numbers::pi * 0.08);
  EXPECT_NEAR(f.x, base * 0.9 + gloss, 1e-4);
  EXPECT_NEAR(f.y, gloss, 1e-4);
  EXPECT_NEAR(f.z, base, 1e-4);
}

TEST(Substrate, BlinnHasTheExponentsOfV2) {
  const Scattering substrate(
      "substrate", {rgb("Kd", 0, 0, 0), rgb("Ks", 0.1F, 0.1F, 0.1F), number("uroughness", 0.1F),
                    number("vroughness", 0.5F), text("distribution", "blinn")});
  EXPECT_NEAR(substrate->f({0, 0, 1}, {0, 0, 1}).x,
              0.1 * std::sqrt(12.0 * 4) / (2 * std::numbers::pi) / 4, 1e-4);
}

TEST(Substrate, EnergyIsKeptWhateverTheMixture) {
  for (const float kd : {0.F, 1.F})
    for (const float ks : {0.05F, 0.5F, 1.F})
      for (const float roughness : {0.05F, 0.3F, 1.F})
        for (const double angle : {0.0, 45.0, 80.0, 89.0}) {
          const Scattering substrate(
              "substrate",
              {rgb("Kd", kd, kd, kd), rgb("Ks", ks, ks, ks), number("uroughness", roughness),
               number("vroughness", roughness), flag("remaproughness", false)});
          EXPECT_LE(albedo(*substrate.operator->(), direction(angle), 20000), 1.02)
              << kd << " " << ks << " " << roughness << " at " << angle;
        }
}

TEST(Substrate, BlackIsNoLobe) {
  EXPECT_EQ(Scattering("substrate", {rgb("Kd", 0, 0, 0), rgb("Ks", 0, 0, 0)})->lobes(kAllLobes), 0);
}

}  // namespace
}  // namespace pbrt::test
