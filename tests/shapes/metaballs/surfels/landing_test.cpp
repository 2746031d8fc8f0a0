#include "shapes/metaballs/surfels/landing.h"

#include <gtest/gtest.h>

#include "tests/shapes/metaballs/surfels/fields.h"

namespace pbrt::surfels::test {
namespace {

TEST(Landing, IsOnTheSurfaceNearestToTheStart) {
  const Balls ball({{{1, 2, 3}, 0.5}});
  std::vector<Landing> points;
  std::vector<DVec3> directions;
  for (std::uint32_t i = 0; i < 600; ++i) {
    Rng rng(i);
    directions.push_back(DVec3(uniformSphere({rng.uniform(), rng.uniform()})));
    points.push_back({DPoint3(1, 2, 3) + (0.1 + 0.001 * i) * directions.back()});
  }
  land(ball, points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    ASSERT_TRUE(points[i].there) << i;
    EXPECT_LE(std::abs(points[i].value), kOnSurface);
    // f is off by 1e-4 where its slope is 4: the distance, by 2.5e-5.
    EXPECT_LT(glm::length(points[i].p - DPoint3(1, 2, 3) - 0.5 * directions[i]), 3e-5);
  }
}

// What Newton's method runs away from: f = cbrt(1 - |x|).
class CubeRoot : public MovingField {
 public:
  Bounds3 bounds() const override { return {Point3(-1), Point3(1)}; }
  double grain() const override { return 1; }
  void at(std::span<const DPoint3> points, std::span<FieldAt> out) const override {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double r = glm::length(points[i]), f = std::cbrt(1 - r);
      out[i] = {f, -1 / (3 * f * f) * points[i] / r};
    }
  }
  void shape(std::span<const DPoint3>, std::span<ShapeAt>) const override {}
  bool seeds(std::uint64_t, std::span<DPoint3>) const override { return false; }
};

TEST(Landing, HalvesWhereNewtonsMethodFails) {
  std::vector<Landing> points{{{0.9, 0, 0}}, {{0, 1.3, 0}}, {{0, 0, 0.6}}};
  land(CubeRoot(), points);
  for (const Landing& p : points) {
    EXPECT_TRUE(p.there);
    EXPECT_NEAR(glm::length(p.p), 1, 1e-11);
  }
}

// Answers one and the same everywhere.
class Same : public CubeRoot {
 public:
  explicit Same(const FieldAt& answer) : answer_(answer) {}
  void at(std::span<const DPoint3> points, std::span<FieldAt> out) const override {
    std::fill_n(out.begin(), points.size(), answer_);
  }

 private:
  FieldAt answer_;
};

TEST(Landing, GivesUpWhereThereIsNothingToFollow) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const FieldAt& answer :
       {FieldAt{-1, {}}, FieldAt{1, {}}, FieldAt{0, {}}, FieldAt{-1, {1e-300, 0, 0}},
        FieldAt{1e300, {1e300, 1e300, 0}}, FieldAt{nan, {1, 0, 0}}, FieldAt{0, {nan, 0, 0}},
        FieldAt{0, {infinity, 0, 0}}, FieldAt{0, {1, 0, 0}, {nan, 0, 0}}, FieldAt{1, {1, 0, 0}}}) {
    std::vector<Landing> points{{{1, 2, 3}}, {{nan, 0, 0}}, {{infinity, 0, 0}}, {{1e300, 0, 0}}};
    land(Same(answer), points);
    for (const Landing& p : points) EXPECT_FALSE(p.there) << answer.value;
  }
}

}  // namespace
}  // namespace pbrt::surfels::test
