// One sample of one light, whatever the lights are: very many, very bright beside very dim, in odd
// places.

#include <sys/resource.h>

#include <chrono>

#include "tests/integrators/estimate.h"

namespace pbrt {
namespace {

using namespace test;

const std::string kFromAbove = "0 -0.2 0.2  0 0 0  0 0 1";
const std::string kFloor =
    "Material \"matte\" \"rgb Kd\" [0.8 0.8 0.8]\n"
    "Shape \"disk\" \"float radius\" 0.4\n";
const std::string kBlack = "Material \"matte\" \"rgb Kd\" [0 0 0]\n";

std::string point(const Point3& p, double I) {
  return fmt::format("LightSource \"point\" \"rgb I\" [{0} {0} {0}] \"point from\" [{1} {2} {3}]\n",
                     I, p.x, p.y, p.z);
}
std::string sphere(const Point3& p, double r, double L) {
  return fmt::format(
      "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [{0} {0} {0}]\n{1}"
      "Translate {2} {3} {4} Shape \"sphere\" \"float radius\" {5} AttributeEnd\n",
      L, kBlack, p.x, p.y, p.z, r);
}
// Of the floor's middle, for the light of a point.
double fromPoint(const Point3& p, double I) {
  const double d2 = lengthSquared(DPoint3(p));
  return 0.8 / std::numbers::pi * I * p.z / (d2 * std::sqrt(d2));
}

std::string byPath(const std::string& strategy) {
  return path(1, "\"string lightsamplestrategy\" \"" + strategy + "\"");
}
std::string byDirect(const std::string& strategy) {
  return "\"directlighting\" \"string strategy\" \"" + strategy + "\"";
}

class ManyLights : public testing::TestWithParam<std::string> {
 protected:
  const std::string& integrator() const { return GetParam(); }
};

// The bright one is behind a screen: nothing is left but what the dim one sends.
TEST_P(ManyLights, AHiddenLightOf1e30DoesNotHideOneOf1eMinus30) {
  const std::string screen = "AttributeBegin " + kBlack +
                             "Translate 0.5 0 1 Shape \"disk\" \"float radius\" 0.3 AttributeEnd\n";
  const Point3 bright(1, 0, 2), dim(0, 1, 1);
  const Estimate points =
      estimate(kFromAbove, integrator(), point(bright, 1e30) + point(dim, 1e-30) + screen + kFloor);
  expectMean(points, fromPoint(dim, 1e-30));
  EXPECT_LT(points.error(), 0.1 * points.mean);
  // A ball of radius r and radiance L is a point of intensity pi r^2 L, all above the horizon.
  const Estimate balls =
      estimate(kFromAbove, integrator(),
               sphere(bright, 0.1, 1e30) + sphere(dim, 0.1, 1e-30) + screen + kFloor);
  expectMean(balls, fromPoint(dim, 1e-30 * std::numbers::pi * 0.01));
  EXPECT_LT(balls.error(), 0.1 * balls.mean);
}

TEST_P(ManyLights, ALightOf1e30BesideOneOf1eMinus30) {
  const Point3 bright(1, 0, 2), dim(0, 1, 1);
  expectMean(estimate(kFromAbove, integrator(), point(bright, 1e30) + point(dim, 1e-30) + kFloor),
             fromPoint(bright, 1e30));
}

// In the floor's own middle, below it, on it, black, and of no area; each beside one lamp that
// counts.
TEST_P(ManyLights, LightsThatSendNothing) {
  const Point3 lamp(0.5F, 0, 1);
  const std::string odd[] = {
      point(Point3(0), 1),
      point({0, 0, -1}, 1e3),
      point({0.1F, 0, 0}, 1),
      sphere({0, 0, -2}, 0.5, 1e3),
      sphere({1, 1, 1}, 0.5, 0),
      "LightSource \"distant\" \"rgb L\" [0 0 0]\nLightSource \"infinite\" \"rgb L\" [0 0 0]\n",
      "AttributeBegin AreaLightSource \"diffuse\" Shape \"trianglemesh\" \"integer indices\" [0 1 "
      "2] \"point P\" [0 0 1  1 0 1  0.5 0 1] AttributeEnd\n"};
  for (const std::string& other : odd)
    expectMean(estimate(kFromAbove, integrator(), point(lamp, 3) + other + kFloor),
               fromPoint(lamp, 3));
}

// From within a ball that shines inward, its radiance is everywhere; a lamp hangs in it.
TEST_P(ManyLights, WithinALight) {
  const std::string ball = "AttributeBegin AreaLightSource \"diffuse\" " + kBlack +
                           "ReverseOrientation Shape \"sphere\" \"float radius\" 5 AttributeEnd\n";
  const Point3 lamp(0.5F, 0, 1);
  expectMean(estimate(kFromAbove, integrator(), ball + point(lamp, 3) + kFloor),
             0.8 + fromPoint(lamp, 3));
}

// Lamps near and far, spots, a ceiling, a sun and a sky: the mean is one for all strategies.
TEST_P(ManyLights, AllStrategiesMeanTheSame) {
  std::string world =
      sphere({0.3F, 0.2F, 0.5F}, 0.1, 2) + sphere({-2, 1, 3}, 0.5, 8) + point({1, -1, 0.5F}, 0.3) +
      "LightSource \"spot\" \"rgb I\" [2 2 2] \"point from\" [-1 0 1] \"point to\" [0 0 0]\n"
      "LightSource \"spot\" \"rgb I\" [9 9 9] \"point from\" [-1 0 1] \"point to\" [-1 0 5]\n"
      "LightSource \"distant\" \"point from\" [1 1 1] \"point to\" [0 0 0]\n"
      "LightSource \"infinite\" \"rgb L\" [0.1 0.1 0.1]\n"
      "AttributeBegin AreaLightSource \"diffuse\" " +
      kBlack +
      "Translate 0 0 4 ReverseOrientation Shape \"disk\" \"float radius\" 1 AttributeEnd\n" +
      kFloor;
  expectSame(estimate(kFromAbove, integrator(), world),
             estimate(kFromAbove, byDirect("all"), world, 60));
}

INSTANTIATE_TEST_SUITE_P(Strategies, ManyLights,
                         testing::Values(byPath("uniform"), byPath("power"), byPath("spatial"),
                                         byDirect("one"), byDirect("weighted")),
                         [](const auto& test) {
                           std::string name;
                           for (const char c : test.param)
                             if (std::isalpha(static_cast<unsigned char>(c))) name += c;
                           return name;
                         });

// Of two equal flat lamps in one place, one faces away, however they are made and placed: the tree
// knows it.
TEST(ManyLightsTree, KnowsWhichWayFlatLampsFace) {
  const std::string square =
      "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3]\n"
      "\"point P\" [-0.1 -0.1 0  0.1 -0.1 0  0.1 0.1 0  -0.1 0.1 0]";
  for (const std::string& shape :
       {square, "Scale -1 1 1 " + square, "Rotate 180 1 0 0 Scale 2 2 0.5 " + square,
        square + " \"normal N\" [0 0 -1  0 0 -1  0 0 -1  0 0 -1]",
        std::string("Scale 1 -1 3 Shape \"disk\" \"float radius\" 0.1")}) {
    std::string world = kFloor;
    for (const char* turn : {"", "ReverseOrientation"})
      world += fmt::format(
          "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [9 9 9]\n{} {} Translate 0 0 1 {} "
          "AttributeEnd\n",
          kBlack, turn, shape);
    const Estimate spatial = estimate(kFromAbove, byPath("spatial"), world);
    const Estimate uniform = estimate(kFromAbove, byPath("uniform"), world);
    expectSame(spatial, uniform);
    EXPECT_LT(5 * spatial.variance, uniform.variance) << shape;
  }
}

// A hundred thousand points over the floor, of intensities between 0.01 and 1, within 50 units.
TEST(ManyLightsScale, AHundredThousandPoints) {
  Rng rng(1);
  std::string lights;
  double expected = 0;
  for (int i = 0; i < 100'000; ++i) {
    const Point3 p(100 * rng.uniform() - 50, 100 * rng.uniform() - 50, 0.3F + rng.uniform());
    const float I = std::pow(0.01F, rng.uniform());
    lights += point(p, I);
    expected += fromPoint(p, I);
  }
  const auto seconds = [start = std::chrono::steady_clock::now()] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  const auto check = [&](const std::string& strategy) {
    const double start = seconds();
    const Estimate e = estimate(kFromAbove, byPath(strategy), lights + kFloor);
    expectMean(e, expected);
    fmt::print("{}: sigma {:.2f} of the mean, {:.2f} s\n", strategy, std::sqrt(e.variance) / e.mean,
               seconds() - start);
    return e.variance;
  };
  const double spatial = check("spatial");
  EXPECT_LT(50 * spatial, check("power"));
  EXPECT_LT(50 * spatial, check("uniform"));
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  fmt::print("peak {} MB\n", usage.ru_maxrss / 1024);
}

}  // namespace
}  // namespace pbrt
