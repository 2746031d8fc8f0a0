#include "core/base/rng.h"
#include "core/base/warp.h"
#include "tests/support.h"

namespace pbrt {
namespace {

using test::number;
using test::text;

const std::vector<std::string> kMappings{"equirectangular", "equalarea"};

std::unique_ptr<Camera> camera(const std::string& mapping, const Transform& toRender = {},
                               Point2i resolution = {400, 200}) {
  return test::make<Camera>("environment", {text("mapping", mapping)}, {toRender, resolution});
}
Vec3 towards(const Camera& c, float x, float y) {
  return c.generate({{x, y}, {}, 0}, false).ray.d;
}
void expectDirection(const Vec3& a, const Vec3& b) {
  EXPECT_LT(glm::distance(a, b), 1e-6F) << a.x << " " << a.y << " " << a.z;
}

// As in every pbrt: the left side shows +x, and a quarter to the right of it is ahead.
TEST(EnvironmentCamera, UnrollsTheSphereByLongitudeAndLatitude) {
  const auto c = test::make<Camera>("environment", {}, {{}, {400, 200}});
  expectDirection(towards(*c, 0, 100), {1, 0, 0});
  expectDirection(towards(*c, 100, 100), {0, 0, 1});
  expectDirection(towards(*c, 200, 100), {-1, 0, 0});
  expectDirection(towards(*c, 300, 100), {0, 0, -1});
  expectDirection(towards(*c, 400, 100), {1, 0, 0});
  for (const float x : {0.F, 123.F, 400.F}) {
    expectDirection(towards(*c, x, 0), {0, 1, 0});
    expectDirection(towards(*c, x, 200), {0, -1, 0});
  }
  expectDirection(towards(*c, 100, 50), glm::normalize(Vec3(0, 1, 1)));
}

TEST(EnvironmentCamera, UnfoldsTheSphereOntoASquare) {
  const auto c = camera("equalarea", {}, {100, 100});
  expectDirection(towards(*c, 50, 50), {0, 1, 0});
  expectDirection(towards(*c, 100, 50), {1, 0, 0});
  expectDirection(towards(*c, 0, 50), {-1, 0, 0});
  expectDirection(towards(*c, 50, 100), {0, 0, 1});
  expectDirection(towards(*c, 50, 0), {0, 0, -1});
  for (const float x : {0.F, 100.F})
    for (const float y : {0.F, 100.F}) expectDirection(towards(*c, x, y), {0, -1, 0});
}

// Solid angle of a small patch of the picture, by its sides, over its share of the picture.
TEST(EnvironmentCamera, PatchesFillTheSolidAngleOfTheMap) {
  Rng rng(2);
  for (const std::string& mapping : kMappings) {
    const auto c = camera(mapping, {}, {1, 1});
    for (int i = 0; i < 2000; ++i) {
      const float h = 0x1p-9F;
      const Point2 p(0.01F + 0.97F * rng.uniform(), 0.01F + 0.97F * rng.uniform());
      const DVec3 a(towards(*c, p.x, p.y)), b(towards(*c, p.x + h, p.y)),
          d(towards(*c, p.x, p.y + h));
      const double angle = glm::length(glm::cross(b - a, d - a)) / (h * h);
      const double sine = std::sin(std::numbers::pi * (p.y + h / 2));
      const double expected =
          mapping == "equalarea" ? 4 * std::numbers::pi : 2 * sqr(std::numbers::pi) * sine;
      // The map bends at the axes and along the equator.
      const double u = std::abs(2 * p.x - 1), v = std::abs(2 * p.y - 1);
      const bool bends = std::min({u, v, std::abs(1 - u - v)}) < 16 * h;
      if (mapping == "equalarea" && bends) continue;
      EXPECT_NEAR(angle, expected, 0.03 * expected + 0.05) << mapping << p.x << " " << p.y;
    }
  }
}

TEST(EnvironmentCamera, EveryDirectionIsSeenOnceAndFromOnePoint) {
  const Transform moved = Transform::translate({3, -2, 7}) * Transform::rotate(50, {1, 2, -1}) *
                          Transform::scale({-2, 2, 2});
  Rng rng(3);
  for (const std::string& mapping : kMappings) {
    const auto c = camera(mapping, moved, {64, 64});
    // Of directions uniform over the picture's solid angle every octant gets an eighth.
    std::array<double, 8> share{};
    for (int i = 0; i < 256; ++i)
      for (int j = 0; j < 256; ++j) {
        const Point2 film(0.25F * (float(i) + rng.uniform()), 0.25F * (float(j) + rng.uniform()));
        const CameraRay r = c->generate({film, {}, 0}, false);
        EXPECT_EQ(r.weight, 1);
        EXPECT_EQ(r.ray.o, Point3(3, -2, 7));
        EXPECT_NEAR(glm::length(DVec3(r.ray.d)), 1, 2e-7);
        const double weight =
            mapping == "equalarea" ? 1 : std::sin(kPi * film.y / 64) * std::numbers::pi / 2;
        const DVec3 w = moved.inverse().vector(DVec3(r.ray.d));
        share[(w.x > 0 ? 1U : 0U) | (w.y > 0 ? 2U : 0U) | (w.z > 0 ? 4U : 0U)] +=
            weight / (256 * 256);
      }
    for (const double s : share) EXPECT_NEAR(s, 0.125, 1e-3) << mapping;
  }
}

TEST(EnvironmentCamera, DifferentialsAreTheNeighboursRaysAlsoAcrossTheBorder) {
  Rng rng(4);
  for (const std::string& mapping : kMappings) {
    const auto c = camera(mapping, {}, {64, 64});
    for (int i = 0; i < 1000; ++i) {
      CameraSample s;
      s.film = 64.F * Point2(rng.uniform(), rng.uniform());
      if (i % 2) s.film[i / 2 % 2] = 63.5F;
      const RayDifferential ray = c->generate(s, true).ray;
      ASSERT_TRUE(ray.hasDifferentials);
      EXPECT_EQ(ray.rxOrigin, ray.o);
      EXPECT_EQ(ray.ryOrigin, ray.o);
      // A pixel is at most a few degrees wide, whichever way.
      EXPECT_LT(glm::distance(ray.rxDirection, ray.d), 0.2F)
          << mapping << s.film.x << " " << s.film.y;
      EXPECT_LT(glm::distance(ray.ryDirection, ray.d), 0.2F);
      if (s.film.x < 63 && s.film.y < 63) {
        EXPECT_EQ(ray.rxDirection, towards(*c, s.film.x + 1, s.film.y));
        EXPECT_EQ(ray.ryDirection, towards(*c, s.film.x, s.film.y + 1));
      }
    }
  }
}

TEST(EnvironmentCamera, ClipsByDistanceAndTellsTheTime) {
  const auto c = test::make<Camera>("environment",
                                    {number("hither", 0.5F), number("yon", 20),
                                     number("shutteropen", 2), number("shutterclose", 6)},
                                    {{}, {10, 10}});
  const Ray ray = c->generate({{3, 4}, {}, 0.25F}, false).ray;
  EXPECT_EQ(ray.tMin, 0.5F);
  EXPECT_EQ(ray.tMax, 20);
  EXPECT_EQ(ray.time, 3);
  EXPECT_FALSE(c->usesLens());
  EXPECT_FALSE(c->screenFromCamera());
}

TEST(EnvironmentCamera, SaysWhatIsWrong) {
  for (const ParamList& bad : std::vector<ParamList>{
           {text("mapping", "mercator")},
           {number("hither", 2), number("yon", 1)},
           {number("shutteropen", 2), number("shutterclose", 1)},
           {number("fov", 90)},
       })
    EXPECT_THROW(test::make<Camera>("environment", bad, {{}, {10, 10}}), Error) << bad.front().name;
}

}  // namespace
}  // namespace pbrt
