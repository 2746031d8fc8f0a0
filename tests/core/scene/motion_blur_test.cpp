// What moves: where it is met at every moment, and the blur that comes of it, against closed forms.

#include <fmt/format.h>

#include "core/base/rng.h"
#include "core/base/warp.h"
#include "core/scene/scene.h"
#include "tests/scenes.h"

namespace pbrt {
namespace {

// Seen from (0, 0, 0) along +z, so that render space is world space.
std::unique_ptr<Scene> world(const std::string& statements) {
  return test::buildText("Integrator \"whitted\" WorldBegin\n" + statements + "\nWorldEnd");
}

Ray randomRay(Rng& rng, const Point3& centre, float radius) {
  const Vec3 o = centre + 4 * radius * uniformSphere({rng.uniform(), rng.uniform()});
  const Vec3 to = centre + radius * uniformSphere({rng.uniform(), rng.uniform()});
  return {o, 0, to - o, kInfinity, rng.uniform()};
}

// -- where things are
// ------------------------------------------------------------------------------

// What a ray down the z axis at (x, y) and at a time meets: the point's z, or NaN.
float seen(const Scene& scene, float x, float y, float time) {
  const Hit hit = scene.intersect(Ray{{x, y, 100}, 0, {0, 0, -1}, kInfinity, time});
  return hit.found() ? 100 - hit.t : std::numeric_limits<float>::quiet_NaN();
}

TEST(MotionBlur, AStatementChangesTheActiveEndsOnly) {
  const auto scene = world(
      "Translate 1 0 0 ActiveTransform EndTime Translate 4 0 0\n"
      "ActiveTransform StartTime Translate 0 8 0 ActiveTransform All Translate 0 1 0\n"
      "Shape \"sphere\"");
  EXPECT_TRUE(scene->moves());
  EXPECT_FLOAT_EQ(seen(*scene, 1, 9, 0), 1);
  EXPECT_FLOAT_EQ(seen(*scene, 5, 1, 1), 1);
  EXPECT_FLOAT_EQ(seen(*scene, 3, 5, 0.5F), 1);
  EXPECT_TRUE(std::isnan(seen(*scene, 3, 5, 0)));
  EXPECT_FALSE(world("ActiveTransform EndTime Translate 4 0 0 Identity Shape \"sphere\"")->moves());
  EXPECT_FALSE(world("ActiveTransform EndTime Translate 4 0 0 ActiveTransform StartTime\n"
                     "Translate 4 0 0 Shape \"sphere\"")
                   ->moves());
}

TEST(MotionBlur, BlocksRestoreWhatIsActive) {
  for (const std::string block : {"Attribute", "Transform"}) {
    const auto scene = world(block + "Begin ActiveTransform EndTime Translate 0 9 0 " + block +
                             "End Translate 2 0 0 Shape \"sphere\"");
    EXPECT_FALSE(scene->moves());
    EXPECT_FLOAT_EQ(seen(*scene, 2, 0, 0), 1);
  }
}

TEST(MotionBlur, ANamedCoordinateSystemMovesToo) {
  const auto scene = world(
      "TransformBegin ActiveTransform EndTime Translate 4 0 0 CoordinateSystem \"here\"\n"
      "TransformEnd Translate 9 9 9 ActiveTransform StartTime CoordSysTransform \"here\"\n"
      "Shape \"sphere\"");
  EXPECT_FLOAT_EQ(seen(*scene, 0, 0, 0), 1);
  EXPECT_FLOAT_EQ(seen(*scene, 4, 0, 1), 1);
}

TEST(MotionBlur, OutsideOfItsTimesEverythingRests) {
  const auto scene = test::buildText(
      "TransformTimes 2 6 Integrator \"whitted\" WorldBegin\n"
      "ActiveTransform EndTime Translate 4 0 0 Shape \"sphere\" WorldEnd");
  for (const auto& [time, x] :
       {std::pair(-9.F, 0.F), {2.F, 0.F}, {3.F, 1.F}, {6.F, 4.F}, {99.F, 4.F}})
    EXPECT_FLOAT_EQ(seen(*scene, x, 0, time), 1) << time;
}

// An instance moves, and a shape within its object, and both at once.
TEST(MotionBlur, WhatMovesWithinAnObjectMovesWithItsInstances) {
  const auto scene = world(
      "ObjectBegin \"o\" Shape \"sphere\"\n"
      "ActiveTransform EndTime Translate 0 8 0 Shape \"sphere\" ObjectEnd\n"
      "TransformBegin Translate 100 0 0 ObjectInstance \"o\" TransformEnd\n"
      "ActiveTransform EndTime Translate 8 0 0 ObjectInstance \"o\"");
  for (const float t : {0.F, 0.25F, 0.7F, 1.F}) {
    EXPECT_FLOAT_EQ(seen(*scene, 100, 0, t), 1);
    EXPECT_FLOAT_EQ(seen(*scene, 100, 8 * t, t), 1);
    EXPECT_FLOAT_EQ(seen(*scene, 8 * t, 0, t), 1);
    EXPECT_FLOAT_EQ(seen(*scene, 8 * t, 8 * t, t), 1);
  }
  EXPECT_TRUE(std::isnan(seen(*scene, 0, 4, 0.5F)));
}

TEST(MotionBlur, ShapesThatMoveAlikeShareATree) {
  const std::string ball = "Shape \"sphere\" Translate 5 0 0 ";
  const auto scene = world(
      "ActiveTransform EndTime Translate 0 4 0 ActiveTransform All\n"
      "Shape \"sphere\" Shape \"disk\"\n" +
      ball + ball);
  const Hit a = scene->intersect(Ray{{0, 2, 9}, 0, {0, 0, -1}, kInfinity, 0.5F});
  const Hit b = scene->intersect(Ray{{5, 2, 9}, 0, {0, 0, -1}, kInfinity, 0.5F});
  ASSERT_TRUE(a.found());
  ASSERT_TRUE(b.found());
  EXPECT_NE(a.instance, b.instance);
}

// -- how exact
// -------------------------------------------------------------------------------------

// On a way that is linear, the hits of a moving sphere lie on the sphere where it is at that time,
// within the error that they state, however far it goes; and rays that leave it never meet it.
TEST(MotionBlur, HitsLieOnTheMovedSphere) {
  for (const double scale : {1.0, 1000.0, 1e6}) {
    const auto scene = world(
        fmt::format("Translate {} 2 3 ActiveTransform EndTime Translate {} 1 0 Shape \"sphere\"",
                    -scale, 2 * scale));
    Rng rng(1);
    int hits = 0;
    for (int i = 0; i < 20000; ++i) {
      const float time = rng.uniform();
      const DPoint3 centre(scale * (2.0 * time - 1), 2.0 + time, 3);
      RayDifferential ray(randomRay(rng, Point3(centre), 1));
      ray.time = time;
      const Hit hit = scene->intersect(ray);
      if (!hit.found()) continue;
      ++hits;
      const SurfaceInteraction s = scene->surface(ray, hit);
      EXPECT_EQ(s.time, time);
      EXPECT_LE(std::abs(glm::distance(DPoint3(s.p), centre) - 1), s.error);
      EXPECT_FALSE(scene->occluded(
          spawnRay(s, s.n + 0.99F * uniformSphere({rng.uniform(), rng.uniform()}))));
    }
    EXPECT_GT(hits, 15000);
  }
}

// Under a motion of every kind, shapes of every kind: a ray that leaves a convex body outward
// meets it no more, one that goes inward does.
TEST(MotionBlur, SurfacesKeepRaysOnTheirSide) {
  for (const std::string shape :
       {"Shape \"sphere\"",
        "Shape \"trianglemesh\" \"integer indices\" [0 2 1 0 1 3 0 3 2 1 2 3]\n"
        "\"point P\" [-1 -1 -1  1 0 -1  0 1 -1  0 0 1]"}) {
    const auto scene = world(
        "Translate 2 1 9 Rotate 20 1 0 0 ActiveTransform EndTime\n"
        "Translate 3 0 -2 Rotate 110 1 2 3 Scale 0.3 2 1.5\n" +
        shape);
    Rng rng(2);
    int hits = 0;
    for (int i = 0; i < 20000; ++i) {
      const RayDifferential ray(randomRay(rng, {3, 1, 8}, 2));
      const Hit hit = scene->intersect(ray);
      if (!hit.found()) continue;
      ++hits;
      const SurfaceInteraction s = scene->surface(ray, hit);
      EXPECT_LT(glm::distance(s.p, ray.at(hit.t)), s.error + 2e-5F);
      const Vec3 aside = 0.9F * uniformSphere({rng.uniform(), rng.uniform()});
      EXPECT_FALSE(scene->occluded(spawnRay(s, s.n + aside)));
      EXPECT_TRUE(scene->occluded(spawnRay(s, aside - s.n)));
    }
    EXPECT_GT(hits, 2000);
  }
}

// -- pictures
// --------------------------------------------------------------------------------------

// The share of rays through (x, y), down the z axis, that meet something while the shutter is open.
struct Coverage {
  double mean;
  int samples;
};
Coverage coverage(double x, double y, const std::string& statements,
                  const std::string& shutter = "\"float shutteropen\" 0 \"float shutterclose\" 1") {
  constexpr int kSide = 64, kSamples = 4;
  const Image image = test::renderText(
      fmt::format("Translate {} {} 0 Scale 1 1 -1 Translate 0 0 -50\n"
                  "Camera \"orthographic\" \"float screenwindow\" [-1e-6 1e-6 -1e-6 1e-6] {}\n"
                  "Film \"image\" \"integer xresolution\" {} \"integer yresolution\" {}\n"
                  "PixelFilter \"box\" Sampler \"random\" \"integer pixelsamples\" {}\n"
                  "Integrator \"whitted\" {} WorldEnd",
                  -x, -y, shutter, kSide, kSide, kSamples, statements));
  return {test::mean(image, "A"), kSide * kSide * kSamples};
}

void expectCoverage(const Coverage& got, double wanted) {
  const double sigma = std::sqrt(wanted * (1 - wanted) / got.samples);
  EXPECT_NEAR(got.mean, wanted, 4.5 * sigma + 2e-6);
}

// A ball of radius 1 on its way from x = 0 to x = way covers (x, y) from when its front comes to
// when its back leaves.
double ballCovers(double x, double y, double way) {
  const double half = std::sqrt(std::max(0.0, 1 - y * y));
  return std::max(0.0, std::min(way, x + half) - std::max(0.0, x - half)) / way;
}

TEST(MotionBlur, AMovingBallCoversWhatItPasses) {
  const std::string ball = "WorldBegin ActiveTransform EndTime Translate 5 0 0 Shape \"sphere\"";
  for (const double x : {-0.9, -0.2, 0.3, 2.5, 4.6, 5.9})
    for (const double y : {0.0, 0.8}) expectCoverage(coverage(x, y, ball), ballCovers(x, y, 5));
  EXPECT_EQ(coverage(-1.01, 0, ball).mean, 0);
}

TEST(MotionBlur, TheShutterShowsItsPartOfTheMotion) {
  const std::string ball =
      "TransformTimes 0.5 1 WorldBegin ActiveTransform EndTime Translate 5 0 0 Shape \"sphere\"";
  // Open from 0 to 2: a quarter of the time at rest at the start, half of it at the end.
  const std::string all = "\"float shutteropen\" 0 \"float shutterclose\" 2";
  expectCoverage(coverage(0, 0, ball, all), 0.25 + 0.25 * ballCovers(0, 0, 5));
  expectCoverage(coverage(2.5, 0, ball, all), 0.25 * ballCovers(2.5, 0, 5));
  expectCoverage(coverage(5, 0, ball, all), 0.5 + 0.25 * ballCovers(5, 0, 5));
  // Open for a moment in the middle: sharp, at x = 2.5.
  const std::string moment = "\"float shutteropen\" 0.75 \"float shutterclose\" 0.75";
  EXPECT_EQ(coverage(3.49, 0, ball, moment).mean, 1);
  EXPECT_EQ(coverage(3.51, 0, ball, moment).mean, 0);
}

TEST(MotionBlur, ATurningNeedleCoversByItsAngle) {
  // At the distance r from its end, a needle of half the width w covers an angle of 2 asin(w / r).
  constexpr double w = 0.02;
  const std::string needle = fmt::format(
      "WorldBegin ActiveTransform EndTime Rotate 90 0 0 1 Shape \"trianglemesh\"\n"
      "\"integer indices\" [0 1 2 0 2 3] \"point P\" [0 -{0} 0  1 -{0} 0  1 {0} 0  0 {0} 0]",
      w);
  for (const double r : {0.1, 0.5, 0.95})
    for (const double degrees : {30.0, 45.0, 71.0}) {
      const double phi = degrees / 180 * std::numbers::pi;
      expectCoverage(coverage(r * std::cos(phi), r * std::sin(phi), needle),
                     2 * std::asin(w / r) / (std::numbers::pi / 2));
    }
}

std::string picture(const std::string& camera, const std::string& world,
                    const std::string& sampler = "halton") {
  return "LookAt 0 1 6  0 0 0  0 1 0\n" + camera +
         "Camera \"perspective\" \"float fov\" 40 \"float lensradius\" 0.05\n"
         "\"float focaldistance\" 6\n"
         "Film \"image\" \"integer xresolution\" 60 \"integer yresolution\" 40\n"
         "Sampler \"" +
         sampler +
         "\" \"integer pixelsamples\" 4\n"
         "Integrator \"directlighting\" WorldBegin\n"
         "LightSource \"distant\" \"point from\" [0 3 9] \"point to\" [0 0 0]\n" +
         world + "WorldEnd";
}

const std::string kThings =
    "Material \"matte\" Shape \"sphere\" \"float radius\" 0.8\n"
    "Shape \"trianglemesh\" \"point P\" [-1 -1 0.5  1.5 -1 0.3  0.2 1.5 -0.5]\n";

double difference(const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.channels[3].size(); ++i)
    sum += std::abs(a.channels[3][i] - b.channels[3][i]);
  return sum / static_cast<double>(a.channels[3].size());
}

// The camera's way and the world's way back are the same picture: the samples are the same, and
// only some on an edge fall to the other side.
TEST(MotionBlur, TheCamerasWayIsTheWorldsWayBack) {
  struct Way {
    std::string view, step, things;
  };
  // Turns are about the eye. There the world's way is a turn only if the things are not moved too.
  for (const auto& [view, step, things] :
       {Way{"", "Translate 1 0.5 -0.7 ", kThings},
        Way{"Identity ", "Rotate 20 1 2 3 ",
            "Shape \"trianglemesh\" \"point P\" [-1 -1 4  1.5 -1 4.3  0.2 1.5 3.5]\n"}}) {
    // The current transform before WorldBegin takes the world to the camera.
    const std::string move = "ActiveTransform EndTime " + step + "ActiveTransform All\n";
    const Image resting = test::renderText(picture(view, things));
    const Image camera = test::renderText(picture(view + move, things));
    const Image world = test::renderText(picture(view, move + things));
    EXPECT_GT(difference(resting, camera), 0.02) << step;
    EXPECT_LT(difference(camera, world), 1e-3) << step;
  }
}

class SameBits : public testing::TestWithParam<std::string> {};

TEST_P(SameBits, ForAnyNumberOfThreadsWhileAllMoves) {
  const std::string scene =
      picture("ActiveTransform EndTime Translate 0.2 0.1 0 Rotate 4 0 0 1 ActiveTransform All\n",
              "ObjectBegin \"o\"\n" + kThings +
                  "ObjectEnd ActiveTransform EndTime Translate 0.5 0 0\n"
                  "Rotate 40 1 0 0 ObjectInstance \"o\" Translate 1 1 0\n" +
                  kThings,
              GetParam());
  const Image one = test::renderText(scene, 1);
  EXPECT_EQ(one.channels, test::renderText(scene, 3).channels);
  const auto split = test::buildText(scene);
  test::renderScene(*split, 2, 0, 1);
  EXPECT_EQ(one.channels, test::renderScene(*split, 1, 1, 4).channels);
}

INSTANTIATE_TEST_SUITE_P(Samplers, SameBits, testing::Values("random", "halton", "lowdiscrepancy"));

// -- what does not move
// ----------------------------------------------------------------------------

std::vector<std::string> warnings(const std::string& statements) {
  std::vector<std::string> found;
  BuildOptions options;
  options.report = [&](const Diagnostic& d) { found.push_back(d.message); };
  test::buildText(
      "Camera \"perspective\" WorldBegin LightSource \"point\"\n"
      "ActiveTransform EndTime Translate 1 0 0\n" +
          statements + " WorldEnd",
      options);
  return found;
}

TEST(MotionBlur, LightsAndTexturesStayAtTheStart) {
  EXPECT_TRUE(warnings("Shape \"sphere\"").empty());
  EXPECT_EQ(warnings("LightSource \"point\" Shape \"sphere\"").size(), 1U);
  EXPECT_EQ(warnings("Texture \"t\" \"float\" \"constant\" Shape \"sphere\"").size(), 1U);
  EXPECT_EQ(warnings("AreaLightSource \"diffuse\" Shape \"sphere\"").size(), 1U);
  const auto scene = world(
      "AreaLightSource \"diffuse\" ActiveTransform EndTime Translate 9 0 0\n"
      "Shape \"sphere\"");
  EXPECT_FALSE(scene->moves());
  EXPECT_FLOAT_EQ(seen(*scene, 0, 0, 1), 1);
}

TEST(MotionBlur, NonsenseIsAnErrorWithAPlace) {
  for (const std::string text :
       {"TransformTimes 1 1 WorldBegin WorldEnd", "TransformTimes 2 1 WorldBegin WorldEnd",
        "TransformTimes -3e38 3e38 WorldBegin WorldEnd",
        "WorldBegin ActiveTransform EndTime Scale 1 1 -1 Shape \"sphere\" WorldEnd",
        "WorldBegin ObjectBegin \"o\" ActiveTransform EndTime Scale 1 1 -1 Shape \"sphere\"\n"
        "ObjectEnd ObjectInstance \"o\" WorldEnd",
        "ActiveTransform EndTime Scale 1 1 -1 Camera \"perspective\" WorldBegin WorldEnd",
        "WorldBegin ActiveTransform EndTime Scale 1e-150 1e-150 1e-150 Shape \"sphere\" WorldEnd",
        "WorldBegin ActiveTransform EndTime Scale 0 1 1 Shape \"sphere\" WorldEnd"}) {
    try {
      test::buildText(text);
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_GT(error.diagnostics().at(0).line, 0U) << text;
    }
  }
}

}  // namespace
}  // namespace pbrt
