// The way between two transforms, against ways known in closed form.

#include "core/base/animated_transform.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/rng.h"

namespace pbrt {
namespace {

double number(Rng& rng, double lo, double hi) {
  return lo + (hi - lo) * rng.uniform();
}

DVec3 vec(Rng& rng) {
  return {number(rng, -1, 1), number(rng, -1, 1), number(rng, -1, 1)};
}

void expectSame(const Transform& a, const Transform& b, double tolerance = 1e-13) {
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r) EXPECT_NEAR(a.matrix()[c][r], b.matrix()[c][r], tolerance);
}

AnimatedTransform way(const Transform& start, const Transform& end) {
  return AnimatedTransform({start, end});
}

TEST(AnimatedTransform, EndsAreExact) {
  const Transform a = Transform::translate({1, 2, 3}) * Transform::rotate(33, {1, 2, 3});
  const Transform b = a * Transform::scale({0.3, 7, 2});
  const AnimatedTransform t = way(a, b);
  EXPECT_TRUE(t.moves());
  for (const double before : {0.0, -1.0}) EXPECT_EQ(t.at(before).matrix(), a.matrix());
  for (const double after : {1.0, 2.0}) EXPECT_EQ(t.at(after).matrix(), b.matrix());
}

TEST(AnimatedTransform, WhatRestsStaysThere) {
  const Transform a = Transform::rotate(33, {1, 2, 3}) * Transform::scale({-0.3, 7, 2});
  EXPECT_FALSE(way(a, a).moves());
  EXPECT_EQ(way(a, a).at(0.4).matrix(), a.matrix());
  EXPECT_EQ(AnimatedTransform().at(0.4).matrix(), glm::dmat4(1));
}

TEST(AnimatedTransform, TranslationsAndScalesAreBlendedLinearly) {
  const AnimatedTransform t = way(Transform::translate({1, -2, 3}) * Transform::scale({1, 2, 4}),
                                  Transform::translate({5, 6, -1}) * Transform::scale({3, 2, 0.5}));
  expectSame(t.at(0.25), Transform::translate({2, 0, 2}) * Transform::scale({1.5, 2, 3.125}));
}

TEST(AnimatedTransform, TurnsAtEvenSpeed) {
  const DVec3 axis(1, -2, 0.5);
  for (const double angle : {1e-7, 0.01, 20.0, 90.0, 179.0, -120.0})
    for (const double f : {0.1, 0.5, 0.9})
      expectSame(way({}, Transform::rotate(angle, axis)).at(f), Transform::rotate(f * angle, axis));
}

TEST(AnimatedTransform, TurnsTheShortWay) {
  const DVec3 axis(0, 0, 1);
  expectSame(way({}, Transform::rotate(300, axis)).at(0.5), Transform::rotate(-30, axis));
  expectSame(way(Transform::rotate(170, axis), Transform::rotate(-170, axis)).at(0.5),
             Transform::rotate(180, axis));
}

// Maps put together from a translation, a rotation and a symmetric stretch must come apart into the
// same, however flat the stretch is and whether it mirrors or not.
TEST(AnimatedTransform, FindsTheParts) {
  Rng rng(1);
  for (int i = 0; i < 2000; ++i) {
    const double sign = i % 2 ? 1 : -1, flattest = std::pow(10, number(rng, -9, 0));
    const auto stretch = [&] {
      const Transform q = Transform::rotate(number(rng, -180, 180), vec(rng));
      return q * Transform::scale(sign * DVec3(flattest, 1, number(rng, 0.5, 4))) * q.inverse();
    };
    const Transform s0 = stretch(), s1 = stretch();
    const Transform turned = Transform::rotate(number(rng, -180, 180), vec(rng));
    const double angle = number(rng, -179, 179);
    const DVec3 axis = vec(rng), t0 = 9.0 * vec(rng), t1 = 9.0 * vec(rng);
    const AnimatedTransform t =
        way(Transform::translate(t0) * turned * s0,
            Transform::translate(t1) * turned * Transform::rotate(angle, axis) * s1);
    const double f = rng.uniform();
    const Transform s((1 - f) * s0.matrix() + f * s1.matrix());
    // A rotation is only as well known as the flattest direction lets it be.
    expectSame(
        t.at(f),
        Transform::translate(glm::mix(t0, t1, f)) * turned * Transform::rotate(f * angle, axis) * s,
        1e-13 / std::max(flattest, 1e-6) + 1e-12);
    EXPECT_EQ(t.at(f).swapsHandedness(), sign < 0);
  }
}

TEST(AnimatedTransform, ThereIsNoWayToTheMirrorImage) {
  EXPECT_THROW(way({}, Transform::scale({1, 1, -1})), Error);
  EXPECT_THROW(way(Transform::scale({-1, -1, -1}), Transform::rotate(180, {0, 0, 1})), Error);
  EXPECT_NO_THROW(way({}, Transform::scale({1, -1, -1})));
}

TEST(MotionTimes, BeforeAndAfterAllRests) {
  const MotionTimes times{2, 6};
  EXPECT_EQ(times.fraction(-9), 0);
  EXPECT_EQ(times.fraction(3), 0.25F);
  EXPECT_EQ(times.fraction(6), 1);
  EXPECT_EQ(times.fraction(kInfinity), 1);
  EXPECT_EQ(times.fraction(std::numeric_limits<float>::quiet_NaN()), 0);
}

}  // namespace
}  // namespace pbrt
