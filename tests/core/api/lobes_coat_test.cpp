// Coated surfaces against walks of single photons through their layers.

#include "core/api/lobes_coat.h"

#include <gtest/gtest.h>

#include "core/base/rng.h"

namespace pbrt {
namespace {

constexpr float kEta = 1.5F;

Vec3 atCosine(float z) {
  return {std::sqrt(1 - z * z), 0, z};
}

double albedo(const Bxdf& lobe, const Vec3& wo, int samples = 100000) {
  Rng rng(1);
  double sum = 0;
  for (int i = 0; i < samples; ++i)
    if (const auto s = lobe.sample(wo, {rng.uniform(), rng.uniform()}))
      sum += s->f.x * std::abs(s->wi.z) / s->pdf;
  return sum / samples;
}

// A weighted photon meets a boundary: chooses reflection or transmission with equal chances. The
// direction comes out as that in which it goes on; zero if it is lost.
Vec3 scatter(const Bxdf& reflection, const Bxdf& transmission, const Vec3& travel, Rng& rng,
             double& weight) {
  const Bxdf& lobe = rng.uniform() < 0.5F ? reflection : transmission;
  const auto s = lobe.sample(-travel, {rng.uniform(), rng.uniform()});
  if (!s) return Vec3(0);
  weight *= 2 * s->f.x * std::abs(s->wi.z) * sqr(s->eta) / s->pdf;
  return s->wi;
}

// The share of light from wo that comes out again after it has met the base at least once.
double walked(const Bxdf& reflection, const Bxdf& transmission, const Bxdf& base, const Vec3& wo,
              int photons) {
  Rng rng(2);
  double sum = 0;
  for (int i = 0; i < photons; ++i) {
    double weight = 1;
    Vec3 w = scatter(reflection, transmission, -wo, rng, weight);
    for (int bounce = 0; w.z < 0 && bounce < 200; ++bounce) {
      const auto s = base.sample(-w, {rng.uniform(), rng.uniform()});
      if (!s) break;
      weight *= s->f.x * std::abs(s->wi.z) / s->pdf;
      w = scatter(reflection, transmission, s->wi, rng, weight);
      if (w.z > 0) sum += weight;
    }
  }
  return sum / photons;
}

TEST(CoatedDiffuse, AWhiteBaseUnderASmoothCoatLosesNothing) {
  const CoatBoundary coat(kEta);
  const CoatedDiffuse white(Spectrum(1), coat);
  for (const float z : {1.F, 0.5F, 0.1F})
    EXPECT_NEAR(albedo(white, atCosine(z)), 1 - fresnelDielectric(z, kEta), 2e-3) << z;
}

TEST(CoatedDiffuse, ASmoothCoatIsAsPhotonsWalk) {
  const SpecularReflection<DielectricFresnel> reflection(Spectrum(1), {kEta});
  const SpecularTransmission transmission(Spectrum(1), kEta);
  for (const float r : {0.2F, 0.7F})
    for (const float z : {1.F, 0.2F}) {
      const double walk =
          walked(reflection, transmission, Lambertian(Spectrum(r)), atCosine(z), 100000);
      EXPECT_NEAR(albedo(CoatedDiffuse(Spectrum(r), CoatBoundary(kEta)), atCosine(z)), walk,
                  0.02 * walk)
          << r << " " << z;
    }
}

TEST(CoatedDiffuse, ARoughCoatIsAsPhotonsWalk) {
  const RoughCoatTable table(kEta);
  for (const float alpha : {0.15F, 0.4F, 1.F}) {
    const TrowbridgeReitz facets(alpha, alpha);
    const MicrofacetReflection<TrowbridgeReitz, DielectricFresnel> reflection(Spectrum(1), facets,
                                                                              {kEta});
    const MicrofacetTransmission<TrowbridgeReitz> transmission(Spectrum(1), facets, kEta);
    for (const float z : {1.F, 0.4F, 0.1F}) {
      const double walk =
          walked(reflection, transmission, Lambertian(Spectrum(0.7F)), atCosine(z), 100000);
      EXPECT_NEAR(albedo(CoatedDiffuse(Spectrum(0.7F), table.boundary(alpha)), atCosine(z)), walk,
                  0.03 * walk)
          << alpha << " " << z;
    }
  }
}

// Thousands of materials of a scene need not fill one each.
TEST(RoughCoatTable, IsSharedByThoseWithOneIndex) {
  const auto table = RoughCoatTable::shared(kEta);
  EXPECT_EQ(RoughCoatTable::shared(kEta), table);
  EXPECT_NE(RoughCoatTable::shared(1.2F), table);
  EXPECT_EQ(table->boundary(0.3F).transmittance(0.5F),
            RoughCoatTable(kEta).boundary(0.3F).transmittance(0.5F));
}

// pi f is no function of anything but the two transmittances.
TEST(CoatedDiffuse, ByHand) {
  const CoatBoundary coat(kEta);
  const CoatedDiffuse lobe(Spectrum(0.5F), coat);
  const double inside = 1 - (1 - 0.0918) / 2.25;  // of index 1.5, Judd 1942
  const double f = 0.96 * 0.96 * 0.5 / (std::numbers::pi * 2.25 * (1 - 0.5 * inside));
  EXPECT_NEAR(lobe.f({0, 0, 1}, {0, 0, 1}).x, f, 1e-4);
  EXPECT_EQ(lobe.f({0, 0, 1}, {0, 0, -1}).x, 0);
}

const ConductorFresnel kGold{Spectrum(0.2F), Spectrum(3)};

TEST(CoatedConductor, BetweenMirrorsEveryReflectionCounts) {
  const SpecularReflection<DielectricFresnel> reflection(Spectrum(1), {kEta});
  const SpecularTransmission transmission(Spectrum(1), kEta);
  const SpecularReflection<ConductorFresnel> base(Spectrum(1), kGold);
  for (const float z : {1.F, 0.5F, 0.1F}) {
    const double walk = walked(reflection, transmission, base, atCosine(z), 100000);
    const CoatedConductorFresnel whole{kEta, kGold};
    EXPECT_NEAR(whole(z).x, fresnelDielectric(z, kEta) + walk, 0.01) << z;
    // The rough one tends to it.
    const CoatedConductor sharp(CoatBoundary(kEta), 1e-3F, 1e-3F, kGold);
    EXPECT_NEAR(albedo(sharp, atCosine(z), 10000), walk, 0.01) << z;
  }
}

// Its highlights are not quite of the right shape, which changes how much leaves the coat at once.
TEST(CoatedConductor, ComesNearTheWalkOfPhotons) {
  const SpecularReflection<DielectricFresnel> reflection(Spectrum(1), {kEta});
  const SpecularTransmission transmission(Spectrum(1), kEta);
  for (const auto& [alpha, tolerance] :
       {std::pair(0.05F, 0.06), std::pair(0.1F, 0.08), std::pair(0.3F, 0.11)}) {
    const TrowbridgeReitz facets(alpha, alpha);
    const MicrofacetReflection<TrowbridgeReitz, ConductorFresnel> base(Spectrum(1), facets, kGold);
    for (const float z : {1.F, 0.5F}) {
      const double walk = walked(reflection, transmission, base, atCosine(z), 100000);
      const CoatedConductor lobe(CoatBoundary(kEta), alpha, alpha, kGold);
      EXPECT_NEAR(albedo(lobe, atCosine(z)), walk, tolerance * walk) << alpha << " " << z;
    }
  }
}

}  // namespace
}  // namespace pbrt
