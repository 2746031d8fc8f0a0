#include "core/base/sphere_map.h"

#include <gtest/gtest.h>

#include "core/base/picture.h"
#include "core/base/rng.h"
#include "core/base/warp.h"

namespace pbrt {
namespace {

constexpr SphereMap kMaps[] = {SphereMap::latlong, SphereMap::equalarea};

TEST(SphereMap, IsInverted) {
  Rng rng(1);
  for (const SphereMap map : kMaps)
    for (int i = 0; i < 10000; ++i) {
      const DVec2 st(rng.uniform(), rng.uniform());
      const DVec3 w = sphereFromSquare(map, st);
      ASSERT_NEAR(glm::length(w), 1, 1e-14);
      ASSERT_NEAR(glm::length(squareFromSphere(map, w) - st), 0, 1e-7) << st.x << " " << st.y;
    }
}

// Near the poles, where 1 - cos vanishes.
TEST(SphereMap, IsExactNearThePoles) {
  for (const SphereMap map : kMaps)
    for (const double z : {1.0, -1.0})
      for (const double sine : {1e-3, 1e-6, 1e-10}) {
        const DVec3 w(sine * 0.6, sine * 0.8, z * std::sqrt(1 - sine * sine));
        const DVec3 back = sphereFromSquare(map, squareFromSphere(map, w));
        EXPECT_NEAR(glm::length(DVec2(back) - DVec2(w)) / sine, 0, 2e-5) << z << " " << sine;
      }
}

TEST(SphereMap, Places) {
  const auto near = [](SphereMap map, DVec2 st, DVec3 w) {
    EXPECT_NEAR(glm::length(sphereFromSquare(map, st) - w), 0, 1e-12) << st.x << " " << st.y;
  };
  near(SphereMap::latlong, {0.3, 0}, {0, 0, 1});
  near(SphereMap::latlong, {0, 0.5}, {1, 0, 0});
  near(SphereMap::latlong, {0.25, 0.5}, {0, 1, 0});
  near(SphereMap::equalarea, {0.5, 0.5}, {0, 0, 1});
  for (const double s : {0.0, 1.0})
    for (const double t : {0.0, 1.0}) near(SphereMap::equalarea, {s, t}, {0, 0, -1});
  near(SphereMap::equalarea, {1, 0.5}, {1, 0, 0});
  near(SphereMap::equalarea, {0.5, 1}, {0, 1, 0});
  near(SphereMap::equalarea, {0, 0.5}, {-1, 0, 0});
}

// |dw/ds x dw/dt| is the solid angle per area of the square.
TEST(SphereMap, EqualArea) {
  Rng rng(2);
  constexpr double h = 1e-6;
  for (int i = 0; i < 2000; ++i) {
    const DVec2 st(rng.uniform(), rng.uniform());
    const DVec2 a = glm::abs(2.0 * st - 1.0);
    if (std::abs(a.x + a.y - 1) < 1e-3 || a.x < 1e-3 || a.y < 1e-3 || a.x > 0.999 || a.y > 0.999)
      continue;  // the folds
    const auto derivative = [&](DVec2 d) {
      return (sphereFromSquare(SphereMap::equalarea, st + h * d) -
              sphereFromSquare(SphereMap::equalarea, st - h * d)) /
             (2 * h);
    };
    const double area = glm::length(glm::cross(derivative({1, 0}), derivative({0, 1})));
    ASSERT_NEAR(area, 4 * std::numbers::pi, 1e-4) << st.x << " " << st.y;
  }
}

// Beyond an edge lies the pixel that is next on the sphere.
TEST(SphereMap, PicturesAreWrappedAsTheSphereIs) {
  constexpr int n = 32;
  const auto direction = [](SphereMap map, int x, int y) {
    return sphereFromSquare(map, {(x + 0.5) / n, (y + 0.5) / n});
  };
  const auto check = [&](SphereMap map, Wrap wrap, int x, int y, int inX, int inY) {
    ASSERT_TRUE(wrapPixel(wrap, n, n, x, y));
    ASSERT_TRUE(x >= 0 && x < n && y >= 0 && y < n);
    EXPECT_LT(glm::length(direction(map, x, y) - direction(map, inX, inY)), 7.0 / n);
  };
  for (int i = 0; i < n; ++i) {
    check(SphereMap::equalarea, Wrap::octahedral, -1, i, 0, i);
    check(SphereMap::equalarea, Wrap::octahedral, n, i, n - 1, i);
    check(SphereMap::equalarea, Wrap::octahedral, i, -1, i, 0);
    check(SphereMap::equalarea, Wrap::octahedral, i, n, i, n - 1);
    check(SphereMap::latlong, Wrap::latlong, -1, i, 0, i);
    check(SphereMap::latlong, Wrap::latlong, n, i, n - 1, i);
  }
  check(SphereMap::equalarea, Wrap::octahedral, -1, -1, 0, 0);
  check(SphereMap::equalarea, Wrap::octahedral, n, -1, n - 1, 0);
  for (const int far : {-1000000, 999999})
    for (const Wrap wrap : {Wrap::octahedral, Wrap::latlong, Wrap::repeat, Wrap::clamp}) {
      int x = far, y = -far;
      ASSERT_TRUE(wrapPixel(wrap, n, 7, x, y));
      ASSERT_TRUE(x >= 0 && x < n && y >= 0 && y < 7);
    }
}

}  // namespace
}  // namespace pbrt
