// The materials of pbrt-v1 that were measured.

#include "tests/materials/scattering.h"

namespace pbrt::test {
namespace {

const char* const kPaints[] = {"bluepaint", "clay", "felt", "primer", "skin"};

// The terms of the fit written out for one pair of directions in a plane with the normal.
TEST(MeasuredMaterials, BluePaintByHand) {
  const double o = 50 * std::numbers::pi / 180, i = 35 * std::numbers::pi / 180;
  const double across = -std::sin(o) * std::sin(i), up = std::cos(o) * std::cos(i);
  const double red = 0.3094 / std::numbers::pi +
                     std::pow(std::max(0.0, 0.870567 * across + 0.803624 * up), 21.820103) +
                     std::pow(std::max(0.0, -0.451218 * across + 0.023123 * up), 2.774499) +
                     std::pow(std::max(0.0, -1.031545 * across + 0.706734 * up), 66.899060);
  const Scattering paint("bluepaint");
  EXPECT_NEAR(paint->f(direction(50, 0), direction(35, std::numbers::pi)).x, red, 1e-5);
}

TEST(MeasuredMaterials, PaintsKeepEnergyByThemselves) {
  for (const char* name : kPaints) {
    const Scattering paint(name);
    for (const double angle : {0., 60., 85., 89.9}) {
      const double share = albedo(*paint.operator->(), direction(angle), 20000);
      EXPECT_GT(share, 0.02) << name << angle;
      EXPECT_LT(share, 0.8) << name << angle;
    }
  }
}

TEST(MeasuredMaterials, ColoursAreThoseOfTheirNames) {
  const auto colour = [](const char* name) {
    return Scattering(name)->f(direction(10), direction(20));
  };
  EXPECT_GT(colour("bluepaint").z, 1.5F * colour("bluepaint").x);
  EXPECT_GT(colour("clay").x, 1.3F * colour("clay").y);
  EXPECT_GT(colour("skin").x, 1.2F * colour("skin").y);
  EXPECT_LT(colour("felt").y, 0.02F);
}

// What the fit alone would send back at 82 degrees is 1.43, 1.45 and 1.60 times what comes.
TEST(MeasuredMaterials, BrushedMetalMakesNoEnergyAnyMore) {
  const Scattering metal("brushedmetal");
  for (const double angle : {70., 80., 82., 84., 88., 89.9}) {
    Mean all;
    Rng rng(1);
    for (int i = 0; i < 40000; ++i) {
      const auto s = metal->sample(direction(angle), {rng.uniform(), rng.uniform()});
      all.add(s ? s->f.z * std::abs(s->wi.z) / s->pdf : 0);
    }
    EXPECT_LT(all.mean(), 1.005 + 4 * all.error()) << angle;
    EXPECT_GT(all.mean(), 0.4) << angle;
  }
  // Seen more steeply it is the fit: 0.488 frontally.
  EXPECT_NEAR(albedo(*metal.operator->(), {0, 0, 1}, 40000), 0.488, 0.005);
}

TEST(MeasuredMaterials, HaveNoParameterButTheBumpMap) {
  for (const char* name : kPaints) {
    EXPECT_NE(make<Material>(name, {number("bumpmap", 0.1F)})->bumpMap(), nullptr);
    EXPECT_THROW(make<Material>(name, {rgb("Kd", 1, 1, 1)}), Error);
  }
}

}  // namespace
}  // namespace pbrt::test
