#include "tools/particles/view.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <random>

#include "tests/scenes.h"

namespace pbrt::test {
namespace {

const Point2i kSizes[] = {{512, 512}, {640, 200}, {30, 1000}, {1, 1}};

// Where a point is seen: x and y from -1 to 1 over the picture, up to rounding.
glm::dvec2 seenAt(const PinholeCamera& camera, Point2i size, const DPoint3& p) {
  // direction(x, y) = a + x b + y c by its definition; p - eye is a multiple of it.
  const DVec3 a = camera.direction(0, 0), b = DVec3(camera.direction(1, 0)) - a,
              c = DVec3(camera.direction(0, 1)) - a;
  const DVec3 solved = glm::inverse(glm::dmat3(b, c, a)) * (p - camera.eye());
  const glm::dvec2 pixel(solved.x / solved.z + 0.5, solved.y / solved.z + 0.5);
  return 2.0 * pixel / glm::dvec2(size) - 1.0;
}

TEST(View, HoldsTheBoxAndIsNotMuchWiderThanIt) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(-1, 1);
  for (const Point2i size : kSizes)
    for (const double fov : {5., 40., 120.})
      for (const DVec3 up : {DVec3(0, 1, 0), DVec3(0, 0, 2), DVec3(0, 0, -1), DVec3(3, -1, 2)})
        for (int i = 0; i < 20; ++i) {
          Bounds3 box;
          for (int k = 0; k < 2; ++k)
            box.add(Point3(3, -7, 2) + Point3(uniform(random), uniform(random), uniform(random)));
          const PinholeCamera camera(viewOf(box, up, size, fov), size);
          EXPECT_GT(glm::dot(DVec3(camera.up()), up), 0);
          double most = 0;
          for (int corner = 0; corner < 8; ++corner) {
            const DPoint3 p(corner & 1 ? box.hi.x : box.lo.x, corner & 2 ? box.hi.y : box.lo.y,
                            corner & 4 ? box.hi.z : box.lo.z);
            EXPECT_GT(glm::dot(p - camera.eye(), DVec3(camera.forward())), 0);
            const glm::dvec2 at = seenAt(camera, size, p);
            most = std::max({most, std::abs(at.x), std::abs(at.y)});
          }
          EXPECT_LT(most, 1);
          EXPECT_GT(most, 0.5);
        }
}

TEST(View, OfNothingIsAViewAllTheSame) {
  for (const Bounds3& box : {Bounds3{}, Bounds3{Point3(2), Point3(2)}}) {
    const PinholeCamera camera(viewOf(box, {0, 1, 0}, {8, 8}, 40), {8, 8});
    EXPECT_TRUE(isFinite(camera.ray(0, 0).d));
  }
}

// A frame and a render of the same file from the same place lie over each other.
TEST(View, IsThatOfAScenesCamera) {
  for (const Point2i size : kSizes) {
    View view;
    view.eye = {1e4, -2, 0.5}, view.look = {1e4 + 1, 3, -2}, view.up = {0.25, 0, 2}, view.fov = 65;
    const auto scene = buildText(fmt::format(
        "LookAt 10000 -2 0.5  10001 3 -2  0.25 0 2\n"
        "Camera \"perspective\" \"float fov\" 65\n"
        "Film \"image\" \"integer xresolution\" {} \"integer yresolution\" {}\nWorldBegin\n",
        size.x, size.y));
    const PinholeCamera camera(view, size);
    for (const Point2i pixel : {Point2i(0), size - 1, size / 2, Point2i(0, size.y - 1)}) {
      const Ray ray = camera.ray(pixel.x, pixel.y);
      const Ray other = scene->camera().generate({Point2(pixel) + 0.5F, {}, 0}, false).ray;
      EXPECT_EQ(ray.o, other.o);
      EXPECT_LT(glm::distance(ray.d, other.d), 1e-6F);
      EXPECT_NEAR(glm::length(ray.d), 1, 1e-6);
    }
  }
}

TEST(View, MustLookSomewhere) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const auto wrong = [](const View& view) {
    try {
      PinholeCamera(view, {8, 8});
    } catch (const Error& error) {
      EXPECT_EQ(error.failure(), Failure::usage);
      EXPECT_THAT(error.what(), testing::HasSubstr("looks nowhere"));
      return true;
    }
    return false;
  };
  EXPECT_FALSE(wrong({.eye = {0, 0, -1}, .look = {}, .up = {0, 1, 0}}));
  EXPECT_TRUE(wrong({.eye = {1, 2, 3}, .look = {1, 2, 3}, .up = {0, 1, 0}}));
  EXPECT_TRUE(wrong({.eye = {1, 2, 3}, .look = {1, 4, 3}, .up = {0, 1, 0}}));
  EXPECT_TRUE(wrong({.eye = {1, 2, 3}, .look = {0, 0, 0}, .up = {0, 0, 0}}));
  EXPECT_TRUE(wrong({.eye = {1, nan, 3}, .look = {0, 0, 0}, .up = {0, 1, 0}}));
}

}  // namespace
}  // namespace pbrt::test
