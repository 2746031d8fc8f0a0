#include "core/base/transform.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "core/base/rng.h"

namespace pbrt {
namespace {

class TransformTest : public testing::Test {
 protected:
  double number() { return 2.0 * rng.uniform() - 1; }
  DVec3 vec() {
    const double x = number();
    const double y = number();
    return {x, y, number()};
  }
  // A product of rotations, translations and scales; sometimes a mirror.
  Transform affine() {
    return Transform::translate(10.0 * vec()) * Transform::rotate(180 * number(), vec()) *
           Transform::scale(vec() + glm::sign(vec()) * 1.1) *
           Transform::rotate(180 * number(), vec());
  }

  Rng rng{1};
};

void expectNear(const DVec3& a, const DVec3& b, double tolerance = 1e-11) {
  EXPECT_LT(glm::length(a - b), tolerance * (1 + glm::length(b)))
      << a.x << ' ' << a.y << ' ' << a.z << " against " << b.x << ' ' << b.y << ' ' << b.z;
}

TEST_F(TransformTest, ProductsAreDoneFromTheRight) {
  for (int i = 0; i < 100; ++i) {
    const Transform a = affine();
    const Transform b = affine();
    const DVec3 p = vec();
    expectNear((a * b).point(p), a.point(b.point(p)));
    expectNear((a * b).vector(p), a.vector(b.vector(p)));
    expectNear((a * b).normal(p), a.normal(b.normal(p)));
    EXPECT_EQ((a * b).swapsHandedness(), a.swapsHandedness() != b.swapsHandedness());
  }
}

TEST_F(TransformTest, TheInverseUndoes) {
  for (int i = 0; i < 100; ++i) {
    const Transform t = affine() * affine();
    EXPECT_TRUE(t.invertible());
    const DVec3 p = vec();
    expectNear(t.inverse().point(t.point(p)), p);
    expectNear(t.inverse().vector(t.vector(p)), p);
    expectNear(t.inverse().normal(t.normal(p)), p);
    expectNear(Transform(t.matrix()).inverse().point(t.point(p)), p, 1e-9);
  }
}

TEST_F(TransformTest, TheElementaryMapsDoWhatTheirNamesSay) {
  expectNear(Transform::translate({1, 2, 3}).point({10, 20, 30}), {11, 22, 33});
  expectNear(Transform::translate({1, 2, 3}).vector({10, 20, 30}), {10, 20, 30});
  expectNear(Transform::scale({2, 3, -4}).point({1, 1, 1}), {2, 3, -4});
  EXPECT_TRUE(Transform::scale({2, 3, -4}).swapsHandedness());
  EXPECT_FALSE(Transform::scale({2, -3, -4}).swapsHandedness());
  // Counter-clockwise about the axis that points to the viewer.
  expectNear(Transform::rotate(90, {0, 0, 2}).vector({1, 0, 0}), {0, 1, 0});
  expectNear(Transform::rotate(90, {3, 0, 0}).vector({0, 1, 0}), {0, 0, 1});
  expectNear(Transform::rotate(90, {0, 1, 0}).vector({0, 0, 1}), {1, 0, 0});
  EXPECT_TRUE(Transform().isIdentity());
  EXPECT_FALSE(Transform::translate({1, 0, 0}).isIdentity());
}

TEST_F(TransformTest, RotationsKeepLengthsAnglesAndTheAxis) {
  for (int i = 0; i < 100; ++i) {
    const DVec3 axis = vec();
    const double degrees = 720 * number();
    const Transform t = Transform::rotate(degrees, axis);
    const DVec3 a = vec();
    const DVec3 b = vec();
    expectNear(t.vector(axis), axis);
    EXPECT_NEAR(glm::dot(t.vector(a), t.vector(b)), glm::dot(a, b), 1e-12);
    EXPECT_FALSE(t.swapsHandedness());
    // By that angle: Rodrigues.
    const DVec3 k = glm::normalize(axis);
    const double r = glm::radians(degrees);
    expectNear(t.vector(a), a * std::cos(r) + glm::cross(k, a) * std::sin(r) +
                                k * glm::dot(k, a) * (1 - std::cos(r)));
  }
}

TEST_F(TransformTest, LookAtSeesWhatItLooksAtStraightAhead) {
  for (int i = 0; i < 100; ++i) {
    const DVec3 eye = 5.0 * vec();
    const DVec3 look = 5.0 * vec();
    const DVec3 up = vec();
    for (const bool mirrored : {false, true}) {
      const Transform t = Transform::lookAt(eye, look, up, mirrored);
      expectNear(t.point(eye), {0, 0, 0});
      expectNear(t.point(look), {0, 0, glm::length(look - eye)});
      EXPECT_NEAR(t.vector(up).x, 0, 1e-12);
      EXPECT_GT(t.vector(up).y, 0);
      EXPECT_NEAR(glm::length(t.vector(up)), glm::length(up), 1e-12);
      EXPECT_EQ(t.swapsHandedness(), mirrored);
    }
  }
  // Along +z with +y up, +x lies on the right of pbrt-v2's pictures and on the left of pbrt-v1's.
  expectNear(Transform::lookAt({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, false).vector({1, 0, 0}),
             {1, 0, 0});
  expectNear(Transform::lookAt({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, true).vector({1, 0, 0}),
             {-1, 0, 0});
}

TEST_F(TransformTest, WhatHasNoInverseSaysSo) {
  EXPECT_FALSE(Transform::scale({1, 0, 1}).invertible());
  EXPECT_FALSE(Transform::rotate(30, {0, 0, 0}).invertible());
  EXPECT_FALSE(Transform(glm::dmat4(0)).invertible());
  EXPECT_FALSE(Transform(glm::dmat4(1, 2, 3, 0, 4, 5, 6, 0, 7, 8, 9, 0, 0, 0, 0, 1)).invertible());
  EXPECT_FALSE(Transform(glm::dmat4(std::nan(""))).invertible());
  EXPECT_FALSE(Transform::lookAt({1, 2, 3}, {1, 2, 3}, {0, 1, 0}, false).invertible());
  EXPECT_FALSE(Transform::lookAt({0, 0, 0}, {0, 0, 5}, {0, 0, 1}, false).invertible());
  EXPECT_FALSE(Transform::lookAt({0, 0, 0}, {0, 0, 5}, {0, 0, 0}, false).invertible());
  EXPECT_TRUE(Transform::scale({1e-6, 1, 1e6}).invertible());
  EXPECT_TRUE(Transform::scale({1e-20, 1e-20, 1e-20}).invertible());
}

TEST_F(TransformTest, WhatIsSingularUpToRoundingSaysSo) {
  for (int i = 0; i < 1000; ++i) {
    // The third column is a combination of the others, as decimals in a file would be.
    const DVec3 a = vec();
    const DVec3 b = vec();
    const DVec3 c = number() * a + number() * b;
    EXPECT_FALSE(Transform(glm::dmat4(glm::dvec4(a, 0), glm::dvec4(b, 0), glm::dvec4(c, 0),
                                      glm::dvec4(vec(), 1)))
                     .invertible());
    EXPECT_FALSE(Transform::lookAt(a, a + b, 0.1 * b, false).invertible());
  }
}

TEST_F(TransformTest, NormalsStayPerpendicular) {
  for (int i = 0; i < 100; ++i) {
    const Transform t = affine();
    const DVec3 a = vec();
    const DVec3 b = vec();
    const DVec3 n = t.normal(glm::cross(a, b));
    EXPECT_NEAR(glm::dot(n, t.vector(a)), 0, 1e-12);
    EXPECT_NEAR(glm::dot(n, t.vector(b)), 0, 1e-12);
  }
}

TEST_F(TransformTest, BoundsHoldTheTransformedBoxAndNoMore) {
  for (int i = 0; i < 100; ++i) {
    Bounds3 box;
    box.add(Point3(vec()));
    box.add(Point3(vec()));
    const Transform t = affine();
    const Bounds3 bounds = t.bounds(box);
    DPoint3 lo(kInfinity);
    DPoint3 hi(-kInfinity);
    for (int corner = 0; corner < 8; ++corner) {
      const DPoint3 p = t.point({(corner & 1 ? box.hi : box.lo).x, (corner & 2 ? box.hi : box.lo).y,
                                 (corner & 4 ? box.hi : box.lo).z});
      lo = glm::min(lo, p);
      hi = glm::max(hi, p);
    }
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_LE(bounds.lo[axis], lo[axis] + 1e-13);
      EXPECT_GE(bounds.hi[axis], hi[axis] - 1e-13);
      EXPECT_NEAR(bounds.lo[axis], lo[axis], 1e-5);
      EXPECT_NEAR(bounds.hi[axis], hi[axis], 1e-5);
    }
  }
  EXPECT_TRUE(affine().bounds(Bounds3()).empty());
}

TEST_F(TransformTest, ProjectDividesByTheFourthCoordinate) {
  const glm::dmat4 m = glm::perspective(1.0, 1.5, 0.5, 8.0);
  for (int i = 0; i < 100; ++i) {
    const DVec3 p = vec() - DVec3(0, 0, 3);
    // x over distance, scaled by the cotangent of half the angle.
    EXPECT_NEAR(Transform(m).project(p).y, p.y / -p.z / std::tan(0.5), 1e-12);
    expectNear(Transform(m).inverse().project(Transform(m).project(p)), p);
  }
}

TEST_F(TransformTest, RaysNameTheSamePointsByTheSameT) {
  for (int i = 0; i < 100; ++i) {
    const Transform t = affine();
    const Ray ray{Point3(vec()), 0.25F, Vec3(vec()), 7};
    const ObjectRay object = t.ray(ray);
    EXPECT_EQ(object.tMin, 0.25);
    EXPECT_EQ(object.tMax, 7);
    const double at = 3 * rng.uniform();
    expectNear(object.at(at), t.point(DPoint3(ray.o) + at * DVec3(ray.d)));
  }
}

}  // namespace
}  // namespace pbrt
