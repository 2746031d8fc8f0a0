#include "tests/lights/surfaces.h"

namespace pbrt::test {
namespace {

TEST(Distant, IsTheSameEverywhere) {
  const auto light = make<Light>("distant", {points("from", {0, 3, 4}), points("to", {0, 0, 0}),
                                             rgb("L", 1, 2, 3), rgb("scale", 2, 2, 2)});
  for (const Point3 p : {Point3(0), Point3(1e6F, 2, 3), Point3(-5, 1e-6F, 0)}) {
    const LightSample s = light->sample(p, {0.3F, 0.8F});
    EXPECT_NEAR(glm::length(s.wi - Vec3(0, 0.6F, 0.8F)), 0, 1e-6);
    EXPECT_EQ(s.L, Spectrum(2, 4, 6));
    EXPECT_EQ(s.pdf, 1);
    EXPECT_FALSE(s.finite);
  }
  EXPECT_TRUE(light->isDelta());
}

// A surface that faces it receives L; any other the cosine of it.
TEST(Distant, Irradiance) {
  const auto light = make<Light>("distant", {points("from", {0, 0, 7}), points("to", {0, 0, 0})});
  EXPECT_FLOAT_EQ(irradiance(*light, Point3(0), {0, 0, 1}).x, 1);
  EXPECT_FLOAT_EQ(irradiance(*light, Point3(0), {0, 0.8F, 0.6F}).x, 0.6F);
  EXPECT_EQ(irradiance(*light, Point3(0), {0, 0, -1}).x, 0);
}

// By default it comes from the origin to (0, 0, 1): against -z.
TEST(Distant, DefaultDirection) {
  EXPECT_EQ(make<Light>("distant")->sample(Point3(0), {0, 0}).wi, Vec3(0, 0, -1));
}

TEST(Distant, TurnsWithItsTransform) {
  const Light::Setup setup{Transform::translate({7, 8, 9}) * Transform::scale({3, 3, 3}) *
                           Transform::rotate(90, {0, 1, 0})};
  const auto light = make<Light>("distant", {}, setup);
  EXPECT_NEAR(glm::length(light->sample(Point3(0), {0, 0}).wi - Vec3(-1, 0, 0)), 0, 1e-6);
}

TEST(Distant, RefusesNoDirection) {
  EXPECT_THROW(make<Light>("distant", {points("to", {0, 0, 0})}), Error);
}

TEST(Distant, Illuminance) {
  const auto light = make<Light>("distant", {number("illuminance", 6), number("scale", 0.5F)});
  EXPECT_FLOAT_EQ(irradiance(*light, Point3(0), {0, 0, -1}).x, 3);
}

}  // namespace
}  // namespace pbrt::test
