#include "tests/support.h"

namespace pbrt {
namespace {

using test::number;

std::unique_ptr<Camera> perspective(const ParamList& list, Point2i resolution,
                                    const Transform& toRender = {}) {
  return test::make<Camera>("perspective", list, {toRender, resolution});
}

using LVec3 = glm::vec<3, long double>;

// The definition: the shorter side subtends the field of view; raster y points down.
LVec3 direction(long double fov, Point2i resolution, Point2 film) {
  const long double half = std::tan(fov / 360 * std::numbers::pi_v<long double>);
  const long double unit = std::min(resolution.x, resolution.y) / 2.0L;
  return glm::normalize(LVec3(half * (film.x - resolution.x / 2.0L) / unit,
                              half * (resolution.y / 2.0L - film.y) / unit, 1));
}

TEST(PerspectiveCamera, CornersLieWhereTheDefinitionPutsThem) {
  for (const Point2i resolution : {Point2i(640, 480), Point2i(1, 1), Point2i(50, 3000)})
    for (const float fov : {1e-3F, 1.F, 45.F, 90.F, 150.F, 179.9F}) {
      const auto camera = perspective({number("fov", fov)}, resolution);
      for (const Point2 corner : {Point2(0, 0), Point2(1, 0), Point2(0, 1), Point2(1, 1),
                                  Point2(0.25F, 0.75F), Point2(0.5F, 0.5F)}) {
        const Point2 film = corner * Point2(resolution);
        const Ray ray = camera->generate({film, {}, 0}, false).ray;
        EXPECT_EQ(ray.o, Point3(0));
        const LVec3 d = direction(fov, resolution, film);
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(ray.d[i], d[i], 4e-7L * std::abs(d[i])) << fov;
      }
    }
}

// What filters take for the size of a pixel, from one of a fifth of a billionth of a turn to one
// that fills half of the view.
TEST(PerspectiveCamera, FootprintsAreTrueAtAnyFieldOfView) {
  const Point2i resolution(640, 480);
  for (const float fov : {1e-3F, 0.1F, 20.F, 90.F, 170.F, 179.9F}) {
    const auto camera = perspective({number("fov", fov)}, resolution);
    for (const Point2 film : {Point2(320.5F, 240.5F), Point2(10, 20), Point2(630, 240)}) {
      const CameraRay r = camera->generate({film, {}, 0}, true);
      EXPECT_EQ(r.weight, 1);
      const LVec3 d = direction(fov, resolution, film);
      for (const Point2 step : {Point2(1, 0), Point2(0, 1)}) {
        const LVec3 to = direction(fov, resolution, film + step) - d;
        const Vec3& neighbour = step.x > 0 ? r.ray.rxDirection : r.ray.ryDirection;
        const LVec3 own = LVec3(neighbour) - LVec3(r.ray.d);
        // A float near 1 is coarser than a narrow pixel.
        for (int c = 0; c < 3; ++c)
          EXPECT_NEAR(own[c], to[c], 3e-4L * glm::length(to) + 1.3e-7L * std::abs(d[c])) << fov;
      }
    }
  }
}

// However the camera is turned, the error of a direction is that of rounding it: two units in the
// last place of a float, or 1e-7 of a radian. A narrower pixel cannot be told from its neighbour.
TEST(PerspectiveCamera, TurnedDirectionsAreAsExactAsFloats) {
  const Point2i resolution(64, 48);
  const Transform turned = Transform::rotate(50, {1, 2, -1});
  for (const float fov : {1e-3F, 1.F, 90.F, 179.9F}) {
    const auto camera = perspective({number("fov", fov)}, resolution, turned);
    for (const Point2 film : {Point2(0, 0), Point2(31, 25), Point2(64, 3)}) {
      const Ray ray = camera->generate({film, {}, 0}, false).ray;
      const LVec3 d = direction(fov, resolution, film);
      const DVec3 expected = turned.vector(DVec3(d));
      EXPECT_LT(glm::distance(DVec3(ray.d), expected), 1.5e-7) << fov;
    }
  }
}

TEST(PerspectiveCamera, MovesWithItsSpace) {
  const Transform toRender = Transform::translate({1, 2, 3}) * Transform::rotate(90, {0, 1, 0});
  const auto camera = perspective({}, {100, 100}, toRender);
  const Ray ray = camera->generate({{50, 50}, {}, 0}, false).ray;
  EXPECT_EQ(ray.o, Point3(1, 2, 3));
  EXPECT_LT(glm::distance(ray.d, Vec3(1, 0, 0)), 1e-7F);  // z turned about y
}

TEST(PerspectiveCamera, HalfFovGoesBeforeFov) {
  const auto whole = perspective({number("fov", 30)}, {64, 48});
  const auto half = perspective({number("fov", 77), number("halffov", 15)}, {64, 48});
  const CameraSample s{{3, 4}, {}, 0};
  EXPECT_EQ(whole->generate(s, false).ray.d, half->generate(s, false).ray.d);
}

TEST(PerspectiveCamera, AnglesOutOfRangeAreErrors) {
  for (const float fov : {0.F, -10.F, 180.F, 360.F, std::numeric_limits<float>::quiet_NaN()})
    EXPECT_THROW(perspective({number("fov", fov)}, {4, 4}), Error) << fov;
  EXPECT_THROW(perspective({number("halffov", 90)}, {4, 4}), Error);
}

}  // namespace
}  // namespace pbrt
