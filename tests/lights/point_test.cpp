#include "tests/lights/surfaces.h"

namespace pbrt::test {
namespace {

TEST(Point, IrradianceFallsWithTheSquareOfTheDistance) {
  const auto light = make<Light>("point", {rgb("I", 2, 3, 4), points("from", {1, 2, 3})});
  const Spectrum E = irradiance(*light, {1, 2, 0}, {0, 0, 1});
  EXPECT_NEAR(E.x, 2.0 / 9, 1e-6);
  EXPECT_NEAR(E.z, 4.0 / 9, 1e-6);
  // cos^3 / h^2 beside the foot of the perpendicular.
  EXPECT_NEAR(irradiance(*light, {5, 2, 0}, {0, 0, 1}).x, 2 * std::pow(0.6, 3) / 9, 1e-6);
}

// Gauss: whatever sphere surrounds it, its flux is 4 pi I.
TEST(Point, Flux) {
  const auto light = make<Light>("point", {rgb("I", 2, 2, 2), points("from", {0.3F, 0.2F, -0.4F})});
  EXPECT_NEAR(flux(*light, 1), 8 * std::numbers::pi, 0.01);
  EXPECT_NEAR(flux(*light, 7), 8 * std::numbers::pi, 0.01);
}

TEST(Point, SampleLiesAtTheLight) {
  const Light::Setup setup{Transform::translate({10, 0, 0}) * Transform::scale({2, 2, 2})};
  const auto light = make<Light>(
      "point", {points("from", {1, 0, 0}), rgb("I", 1, 2, 3), rgb("scale", 3, 2, 1)}, setup);
  const LightSample s = light->sample({12, 0, -2}, {0, 0});
  EXPECT_EQ(s.p, Point3(12, 0, 0));
  EXPECT_EQ(s.wi, Vec3(0, 0, 1));
  EXPECT_EQ(s.n, Normal3(0));
  EXPECT_TRUE(s.finite);
  EXPECT_EQ(s.pdf, 1);
  EXPECT_EQ(s.L, Spectrum(3, 4, 3) / 4.F);
  EXPECT_TRUE(light->isDelta());
}

TEST(Point, NoLightArrivesWhereItIs) {
  EXPECT_EQ(make<Light>("point")->sample({0, 0, 0}, {0, 0}).pdf, 0);
}

// pbrt-v4's parameters: a number for the scale, and the flux in place of the intensity.
TEST(Point, Power) {
  EXPECT_NEAR(flux(*make<Light>("point", {number("power", 6), number("scale", 2)}), 3), 12, 0.02);
  EXPECT_NEAR(flux(*make<Light>("point", {number("power", -1)}), 3), 4 * std::numbers::pi, 0.02);
}

}  // namespace
}  // namespace pbrt::test
