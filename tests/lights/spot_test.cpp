#include "tests/lights/surfaces.h"

namespace pbrt::test {
namespace {

// The share of the intensity that a spot along +z sends `degrees` off its axis.
float share(const Light& light, double degrees, double phi = 1) {
  const double a = degrees * std::numbers::pi / 180;
  const LightSample s = light.sample(
      2.F * Vec3(std::sin(a) * std::cos(phi), std::sin(a) * std::sin(phi), std::cos(a)), {0, 0});
  return s.pdf > 0 ? s.L.x * 4 : 0;
}

TEST(Spot, FalloffBeginsAndEndsWhereItSays) {
  const auto light = make<Light>("spot", {number("coneangle", 40), number("conedeltaangle", 15)});
  EXPECT_FLOAT_EQ(share(*light, 0), 1);
  EXPECT_FLOAT_EQ(share(*light, 24.99), 1);
  EXPECT_LT(share(*light, 25.5), 1);
  EXPECT_GT(share(*light, 39.5), 0);
  EXPECT_EQ(share(*light, 40.01), 0);
  EXPECT_EQ(share(*light, 180), 0);
}

TEST(Spot, FalloffIsTheFourthPowerOfTheCosine) {
  const auto light = make<Light>("spot", {number("coneangle", 40), number("conedeltaangle", 15)});
  const auto cosine = [](double degrees) { return std::cos(degrees * std::numbers::pi / 180); };
  float last = 1;
  for (double a = 25.2; a < 40; a += 0.2) {
    const double x = (cosine(a) - cosine(40)) / (cosine(25) - cosine(40));
    EXPECT_NEAR(share(*light, a), std::pow(x, 4), 1e-5);
    EXPECT_LT(share(*light, a), last);
    last = share(*light, a);
  }
}

// pbrt-v4's: level at both ends of the soft edge, and point symmetric about its middle.
TEST(Spot, SmoothstepIsACubicOfTheCosine) {
  const auto light = make<Light>("spot", {number("coneangle", 40), number("conedeltaangle", 15),
                                          text("falloff", "smoothstep")});
  const double begin = std::cos(std::numbers::pi * 25 / 180);
  const double end = std::cos(std::numbers::pi * 40 / 180);
  for (double x = 0.02; x < 1; x += 0.02) {
    const double degrees = std::acos(end + x * (begin - end)) * 180 / std::numbers::pi;
    EXPECT_NEAR(share(*light, degrees), x * x * (3 - 2 * x), 1e-5) << x;
  }
  EXPECT_FLOAT_EQ(share(*light, 24.99), 1);
  EXPECT_EQ(share(*light, 40.01), 0);
}

TEST(Spot, DefaultsAreThirtyAndFive) {
  const auto light = make<Light>("spot");
  EXPECT_FLOAT_EQ(share(*light, 24.9), 1);
  EXPECT_LT(share(*light, 25.5), 1);
  EXPECT_EQ(share(*light, 30.1), 0);
}

TEST(Spot, SharpEdge) {
  const auto light = make<Light>("spot", {number("coneangle", 20), number("conedeltaangle", 0)});
  EXPECT_FLOAT_EQ(share(*light, 19.99), 1);
  EXPECT_EQ(share(*light, 20.01), 0);
}

// A hemisphere of light: half the flux of a point light.
TEST(Spot, Flux) {
  const auto light =
      make<Light>("spot", {number("coneangle", 90), number("conedeltaangle", 0),
                           points("from", {0.1F, 0.2F, 0.3F}), points("to", {0.1F, 5, 0.3F})});
  EXPECT_NEAR(flux(*light, 1), 2 * std::numbers::pi, 0.05);
}

TEST(Spot, MovesWithItsTransform) {
  const Light::Setup setup{Transform::translate({0, 0, 5}) * Transform::rotate(90, {0, 1, 0})};
  const auto light = make<Light>("spot", {}, setup);  // +z becomes +x
  EXPECT_GT(light->sample({3, 0, 5}, {0, 0}).pdf, 0);
  EXPECT_EQ(light->sample({0, 0, 8}, {0, 0}).pdf, 0);
  EXPECT_EQ(light->sample({3, 0, 5}, {0, 0}).p, Point3(0, 0, 5));
}

// Stretched light space: the cone is one of light space.
TEST(Spot, ConeIsStretchedWithItsSpace) {
  const auto light = make<Light>("spot", {number("coneangle", 45), number("conedeltaangle", 0)},
                                 {Transform::scale({2, 1, 1})});
  EXPECT_GT(light->sample({1.9F, 0, 1}, {0, 0}).pdf, 0);
  EXPECT_EQ(light->sample({2.1F, 0, 1}, {0, 0}).pdf, 0);
  EXPECT_EQ(light->sample({0, 1.1F, 1}, {0, 0}).pdf, 0);
}

TEST(Spot, NoLightArrivesWhereItIs) {
  const LightSample s = make<Light>("spot")->sample({0, 0, 0}, {0, 0});
  EXPECT_EQ(s.pdf, 0);
}

TEST(Spot, RefusesWhatIsNoCone) {
  EXPECT_THROW(make<Light>("spot", {points("from", {1, 1, 1}), points("to", {1, 1, 1})}), Error);
  EXPECT_THROW(make<Light>("spot", {number("coneangle", 0)}), Error);
  EXPECT_THROW(make<Light>("spot", {number("coneangle", 181)}), Error);
  EXPECT_THROW(make<Light>("spot", {number("coneangle", 20), number("conedeltaangle", 30)}), Error);
  EXPECT_THROW(make<Light>("spot", {number("conedeltaangle", -1)}), Error);
  EXPECT_NO_THROW(make<Light>("spot", {number("coneangle", 3)}));
}

TEST(Spot, Power) {
  for (const char* falloff : {"quartic", "smoothstep"})
    for (const float delta : {0.F, 40.F, 80.F}) {
      const auto light = make<Light>("spot", {number("coneangle", 80), text("falloff", falloff),
                                              number("conedeltaangle", delta), number("power", 6)});
      EXPECT_NEAR(flux(*light, 1), 6, 0.05) << falloff << delta;
      EXPECT_NEAR(light->power(1), 6, 1e-5);
    }
}

}  // namespace
}  // namespace pbrt::test
