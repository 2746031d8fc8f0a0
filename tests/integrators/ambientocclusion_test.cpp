// How much of the sky is seen, in closed form.

#include "tests/integrators/estimate.h"

namespace pbrt {
namespace {

using test::Estimate;
using test::estimate;

const std::string kFloor =
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3]"
    " \"point P\" [-100 0 -100  100 0 -100  100 0 100  -100 0 100]\n";
// The floor's origin, from the side.
const std::string kView = "3 0.5 0  0 0 0  0 1 0";

std::string occlusion(const std::string& parameters) {
  return "\"ambientocclusion\" \"float scale\" 1 \"integer nsamples\" 4 " + parameters;
}
const std::string kCosine, kUniform = "\"bool cossample\" \"false\"",
                           kUnweighted = "\"bool weighted\" \"false\"";

// All the sky is seen, whatever the samples: no noise where each counts alike.
TEST(AmbientOcclusion, AnOpenPlaneIsWhite) {
  for (const std::string& how : {kCosine, kUnweighted}) {
    const Estimate e = estimate(kView, occlusion(how), kFloor, 20);
    EXPECT_NEAR(e.least, 1, 1e-6);
    EXPECT_NEAR(e.most, 1, 1e-6);
  }
  test::expectMean(estimate(kView, occlusion(kUniform), kFloor), 1);
}

TEST(AmbientOcclusion, InsideAClosedBoxNothingIsSeen) {
  for (const std::string& world :
       {std::string("Shape \"sphere\" \"float radius\" 5"),
        std::string("Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3 4 6 5 4 7 6 0 5 1 0 4 "
                    "5 1 6 2 1 5 6 2 7 3 2 6 7 3 4 0 3 7 4] \"point P\" [-4 -4 -4 4 -4 -4 4 4 -4 "
                    "-4 4 -4 -4 -4 4 4 -4 4 4 4 4 -4 4 4]")})
    for (const std::string& how : {kCosine, kUniform, kUnweighted})
      EXPECT_EQ(estimate("0.1 0.2 0.3  0.4 -2 0.1  0 0 1", occlusion(how), world, 40).most, 0);
}

// A ball of radius r whose centre is D away, h above the floor, all of it above: by the cosine it
// takes r^2 h / D^3 of the sky (Lambert's law of the sphere), by solid angle its cone's
// 1 - sqrt(1 - r^2 / D^2).
TEST(AmbientOcclusion, ABallTakesItsPartOfTheSky) {
  for (const double x : {0.0, 1.0, 2.5}) {
    const double r = 0.8, h = 1.5, D = std::hypot(x, h);
    const std::string world =
        kFloor + fmt::format("Translate 0 {} {} Shape \"sphere\" \"float radius\" {}", h, x, r);
    for (const std::string& how : {kCosine, kUniform})
      test::expectMean(estimate(kView, occlusion(how), world), 1 - r * r * h / (D * D * D));
    test::expectMean(estimate(kView, occlusion(kUnweighted), world),
                     std::sqrt(1 - r * r / (D * D)));
  }
}

// Under a ceiling at height h it is the sky lower than cos(theta) = h / maxdistance that is seen,
// a share of cos^2.
TEST(AmbientOcclusion, WhatIsFartherThanMaxdistanceHidesNothing) {
  const std::string world = kFloor + "Translate 0 2 0 " + kFloor;
  const auto seen = [&](double most, const std::string& how) {
    return estimate(kView, occlusion(fmt::format("\"float maxdistance\" {} {}", most, how)), world);
  };
  for (const double most : {2.2, 3.0, 10.0}) {
    for (const std::string& how : {kCosine, kUniform})
      test::expectMean(seen(most, how), sqr(2 / most));
    test::expectMean(seen(most, kUnweighted), 2 / most);
  }
  EXPECT_NEAR(seen(1.9, kCosine).least, 1, 1e-6);
}

// Each generation's own names, and white: 1, but pi in v3, which does not divide by it.
TEST(AmbientOcclusion, EveryGenerationSeesItsOwnWhite) {
  const auto white = [&](Dialect dialect, const std::string& integrator) {
    BuildOptions options;
    options.dialect = dialect;
    return test::mean(
        test::renderText("LookAt " + kView + " Camera \"perspective\" \"float fov\" 1 Film \"" +
                             (dialect == Dialect::v4 ? "rgb" : "image") +
                             "\" \"integer xresolution\" 4 \"integer yresolution\" 4 Sampler "
                             "\"random\" \"integer pixelsamples\" 1\n" +
                             integrator + " WorldBegin " + kFloor + "Translate 0 5 0 " + kFloor,
                         0, options),
        "G");
  };
  EXPECT_NEAR(white(Dialect::v2,
                    "SurfaceIntegrator \"ambientocclusion\" \"float maxdist\" 3 "
                    "\"integer nsamples\" 8"),
              1, 1e-6);
  EXPECT_NEAR(white(Dialect::v3, "Integrator \"ambientocclusion\""), 0, 0.1);  // between floors
  EXPECT_NEAR(white(Dialect::v3, "Integrator \"ambientocclusion\" \"float maxdistance\" 3"),
              std::numbers::pi, 1e-5);
  EXPECT_NEAR(white(Dialect::v4, "Integrator \"ambientocclusion\" \"float maxdistance\" 3"), 1,
              1e-6);
}

// From below a floor it is the lower sky that counts; and shading normals have no say.
TEST(AmbientOcclusion, TheSideThatIsSeenCountsByItsTrueNormal) {
  EXPECT_NEAR(estimate("3 -0.5 0  0 0 0  0 1 0", occlusion(kCosine), kFloor, 10).least, 1, 1e-6);
  const std::string bent =
      "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" [-9 0 -9 9 0 -9 9 0 9 "
      "-9 0 9] \"normal N\" [1 0.1 0 1 0.1 0 1 0.1 0 1 0.1 0]";
  EXPECT_NEAR(estimate(kView, occlusion(kCosine), bent, 10).least, 1, 1e-6);
}

}  // namespace
}  // namespace pbrt
