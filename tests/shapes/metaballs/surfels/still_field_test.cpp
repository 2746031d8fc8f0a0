// The surface of any implicit field, in its place: in its own measure, with seeds all over it.

#include "shapes/metaballs/surfels/still_field.h"

#include <gtest/gtest.h>

#include "core/plugin/formula.h"

namespace pbrt::surfels {
namespace {

constexpr double kPiD = std::numbers::pi;

// Two balls, far apart; `unit` is that of the field.
struct Balls {
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    return unit *
           max(1 - (sqr(x) + sqr(y) + sqr(z)), radius * radius - (sqr(x - 10) + sqr(y) + sqr(z)));
  }
  Bounds3 bounds() const { return {Point3(-1.5F), Point3(12, 1.5F, 1.5F)}; }
  double radius = 0.5, unit = 1;
};

// Has no value where x < 0; the surface z = x y / 4 ends at its bounds.
struct Saddle {
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    return sqrt(x) * 0.0 + x * y / 4 - z;
  }
  Bounds3 bounds() const { return {Point3(-1), Point3(1)}; }
};

struct Nothing {
  template <class T>
  T operator()(const T& x, const T&, const T&) const {
    return -1 - sqr(x);
  }
  Bounds3 bounds() const { return {Point3(-1), Point3(1)}; }
};

// Turned, stretched and mirrored.
Transform placed(double scale) {
  return Transform::translate({3, -2, 5}) * Transform::rotate(30, {1, 2, 3}) *
         Transform::scale({-scale, scale, scale});
}

std::vector<DPoint3> seeds(const MovingField& field, std::size_t count) {
  std::vector<DPoint3> points(count);
  EXPECT_TRUE(field.seeds(0, points));
  return points;
}

FieldAt at(const MovingField& field, const DPoint3& p) {
  FieldAt out;
  field.at({&p, 1}, {&out, 1});
  return out;
}

ShapeAt shapeAt(const MovingField& field, const DPoint3& p) {
  ShapeAt out;
  field.shape({&p, 1}, {&out, 1});
  return out;
}

TEST(StillField, KnowsItsArea) {
  const Formula<Balls> balls(Balls{});
  const double area = 4 * kPiD * (1 + 0.25);
  EXPECT_NEAR(StillField(balls, Transform()).area(), area, 0.01 * area);
  EXPECT_NEAR(StillField(balls, placed(3)).area(), 9 * area, 0.09 * area);
  // A ball that becomes an ellipsoid of the half axes 1, 1, 2: a prolate spheroid with
  // e^2 = 3/4 has the area 2 pi (1 + 2 asin(e) / e).
  const double e = std::sqrt(0.75), stretched = 2 * kPiD * (1 + 2 * std::asin(e) / e);
  EXPECT_NEAR(StillField(balls, Transform::scale({1, 1, 2})).area(), 1.25 * stretched,
              0.0125 * stretched);
}

TEST(StillField, SeedsLieOnTheSurfaceByArea) {
  const Formula<Balls> balls(Balls{});
  const StillField field(balls, placed(3));
  const Transform back = placed(3).inverse();
  DVec3 sum(0);
  int small = 0;
  const std::size_t count = 20000;
  for (const DPoint3& p : seeds(field, count)) {
    const DPoint3 q = back.point(p);
    const bool second = q.x > 5;
    small += second;
    const double off = second ? glm::distance(q, DPoint3(10, 0, 0)) - 0.5 : glm::length(q) - 1;
    EXPECT_NEAR(off, 0, 1e-6);
    if (!second) sum += q;
  }
  EXPECT_NEAR(small / static_cast<double>(count), 0.2, 0.005);
  EXPECT_LT(glm::length(sum) / static_cast<double>(count), 0.01);
}

TEST(StillField, ASmallPieceIsAmongTheSeeds) {
  const Formula<Balls> balls(Balls{0.01});
  const StillField field(balls, Transform());
  std::size_t found = 0;
  for (const DPoint3& p : seeds(field, 100000)) found += p.x > 5;
  EXPECT_NEAR(static_cast<double>(found), 10, 5);  // 1e-4 of the area
}

// Whatever the field's unit, and whatever it is stretched by.
TEST(StillField, IsScaledToItsGrain) {
  for (const double unit : {1e-3, 1.0, 1e6})
    for (const double scale : {1e-3, 1.0, 1e4}) {
      const Formula<Balls> balls(Balls{1, unit});
      const StillField field(balls, placed(scale));
      EXPECT_NEAR(field.grain(), scale / std::sqrt(2), 0.01 * scale);
      for (const DPoint3& p : seeds(field, 100)) {
        EXPECT_NEAR(at(field, p).value, 0, 1e-6);
        EXPECT_NEAR(glm::length(at(field, p).gradient) * field.grain(), 2, 0.01);
      }
    }
}

TEST(StillField, GradientAndHessianAreDerivatives) {
  const Formula<Balls> balls(Balls{});
  const StillField field(balls, Transform::scale({1, 2, 0.5}) * placed(2));
  const double h = 1e-4;
  for (const DPoint3& p : seeds(field, 50)) {
    const ShapeAt shape = shapeAt(field, p);
    EXPECT_EQ(shape.gradient, at(field, p).gradient);
    for (int i = 0; i < 3; ++i) {
      DVec3 step(0);
      step[i] = h;
      const FieldAt more = at(field, p + step), less = at(field, p - step);
      EXPECT_NEAR(shape.gradient[i], (more.value - less.value) / (2 * h), 1e-5);
      const DVec3 turn = (more.gradient - less.gradient) / (2 * h);
      EXPECT_LT(glm::distance(shape.hessian[i], turn), 1e-5);
    }
  }
}

TEST(StillField, WithoutAValueIsOutside) {
  const Formula<Saddle> saddle(Saddle{});
  const StillField field(saddle, Transform());
  for (const DPoint3& p : {DPoint3(-0.5, 0, -0.9), DPoint3(5, 5, 5), DPoint3(1e30),
                           DPoint3(std::numeric_limits<double>::quiet_NaN())}) {
    EXPECT_LT(at(field, p).value, 0);
    EXPECT_EQ(at(field, p).gradient, DVec3(0));
    EXPECT_TRUE(std::isfinite(shapeAt(field, p).hessian[0][0]));
  }
  for (const DPoint3& p : seeds(field, 1000)) {
    EXPECT_GE(p.x, 0);
    EXPECT_NEAR(p.z, p.x * p.y / 4, 1e-5);
  }
}

// It goes on a little beyond its bounds, where surfels of its rim have neighbours; what is there is
// not of the shape.
TEST(StillField, EndsAtItsBounds) {
  const Formula<Saddle> saddle(Saddle{});
  const StillField field(saddle, Transform::scale(DVec3(2)));
  const double beyond = 2 + field.grain() / 10;
  EXPECT_GT(at(field, {1, beyond, -1}).value, 0);
  EXPECT_TRUE(field.holds({1, 2, 0.25}));
  EXPECT_FALSE(field.holds({1, beyond, 0.25}));
  EXPECT_LT(at(field, {1, 2 + field.grain() / 7, -1}).value, 0);
}

TEST(StillField, HasNoSeedsWithoutASurface) {
  const Formula<Nothing> nothing(Nothing{});
  const StillField field(nothing, Transform());
  DPoint3 p;
  EXPECT_FALSE(field.seeds(0, {&p, 1}));
  EXPECT_TRUE(field.bounds().empty());
  EXPECT_EQ(field.area(), 0);
}

}  // namespace
}  // namespace pbrt::surfels
