// Kernels keep what they promise; bounds hold; derivatives are those of the value.

#include "shapes/metaballs/field.h"

#include <gtest/gtest.h>

#include "tests/shapes/metaballs/clouds.h"
#include "tests/shapes/metaballs/oracle.h"

namespace pbrt::metaballs::test {
namespace {

std::vector<std::uint32_t> all(const Field& field) {
  std::vector<std::uint32_t> list(field.atoms().size());
  for (std::uint32_t i = 0; i < list.size(); ++i) list[i] = i;
  return list;
}

class Fields : public testing::TestWithParam<Kernel> {};

TEST_P(Fields, KernelsFallAreConvexAndEndAtOne) {
  withKernel(GetParam(), []<class K>(K) {
    EXPECT_NEAR(K::value(0), 1, 0.02);
    for (int i = 0; i < 1000; ++i) {
      const double q = i / 1000.0, d = 1e-5;
      EXPECT_LT(K::value(q + d), K::value(q));
      EXPECT_LE(K::slope(q), K::slope(q + d));
      EXPECT_NEAR((K::value(q + d) - K::value(q)) / d, K::slope(q + d / 2), 1e-8);
      if (q + d >= 1) continue;
      EXPECT_NEAR((K::slope(q + d) - K::slope(q)) / d, K::curvature(q + d / 2), 1e-6);
    }
    for (const double q : {1.0, 1.5, 1e300}) {
      EXPECT_EQ(K::value(q), 0);
      EXPECT_EQ(K::slope(q), 0);
      EXPECT_EQ(K::curvature(q), 0);
    }
    EXPECT_NEAR(K::value(1 - 1e-15), 0, 1e-14);
  });
}

// Simpson's rule: the integral of W over space is 1 whatever h (Mueller et al. 2003).
TEST(Poly6, IntegratesToOne) {
  for (const double h : {0.01, 1.0, 30.0}) {
    const int n = 1000;
    double sum = 0;
    for (int i = 0; i <= n; ++i) {
      const double r = h * i / n;
      const double w = i == 0 || i == n ? 1 : i % 2 ? 4 : 2;
      sum +=
          w * 4 * std::numbers::pi * r * r * scale(Kernel::poly6, h) * Power<3>::value(sqr(r / h));
    }
    EXPECT_NEAR(sum * h / n / 3, 1, 1e-9);
  }
}

TEST_P(Fields, BoundsHold) {
  for (const double unit : {1.0, 1e-6, 1e6})
    for (const double carving : {0.0, 0.3}) {
      const Field field = cloud(12, GetParam(), carving, unit, 4);
      const auto list = all(field);
      Random random(8);
      for (int i = 0; i < 300; ++i) {
        const DPoint3 centre = 2 * unit * random.cube();
        DVec3 half = unit * std::pow(10.0, -random.in(0, 5)) * glm::abs(random.cube());
        const Range wide = field.bound(centre - half, centre + half, list);
        for (int k = 0; k < 8; ++k) {
          const DPoint3 p = centre + (k < 4 ? random.cube() : glm::sign(random.cube())) * half;
          // Along a ray of length zero through p the oracle's value at t = 0 is f(p).
          const auto f = static_cast<double>(Oracle(field, {p, {1, 0, 0}}).value(0));
          EXPECT_LE(wide.lo, f);
          EXPECT_GE(wide.hi, f);
          const Range point = field.bound(p, list);
          EXPECT_LE(point.lo, f);
          EXPECT_GE(point.hi, f);
          EXPECT_LT(point.hi - point.lo, 1e-12);
          EXPECT_NEAR(field.sample(p, list).value, f, 1e-13);
        }
      }
    }
}

// On the surface: the bound is little wider than what the gradient makes of the box.
TEST_P(Fields, BoundsCloseInWithTheSquareOfTheBox) {
  const Field field = cloud(12, GetParam(), 0, 1, 4);
  const auto list = all(field);
  Random random(2);
  int checked = 0;
  for (int i = 0; i < 50; ++i) {
    const DVec3 d = random.direction();
    const ObjectRay ray{0.5 * random.cube() - 5.0 * d, d};
    const auto t = Oracle(field, ray).first();
    if (!t) continue;
    const DPoint3 p = ray.at(static_cast<double>(*t));
    const DVec3 g = glm::abs(field.sample(p, list).gradient);
    for (const double half : {1e-2, 1e-3, 1e-4}) {
      const Range b = field.bound(p - half, p + half, list);
      ASSERT_TRUE(b.contains(0));
      EXPECT_LT(b.hi - b.lo, 2 * half * (g.x + g.y + g.z + 1000 * half));
      ++checked;
    }
  }
  EXPECT_GT(checked, 50);
}

TEST_P(Fields, DerivativesAreThoseOfTheValue) {
  const Field field = cloud(12, GetParam(), 0.3, 1, 6);
  const auto list = all(field);
  Random random(5);
  for (int i = 0; i < 300; ++i) {
    const DPoint3 p = random.cube();
    const FieldSample s = field.sample(p, list);
    const double d = 1e-5;
    bool smooth = true;  // no support ends nearby
    for (const Atom& a : field.atoms())
      smooth &= std::abs(glm::length(p - DPoint3(a.centre)) - a.radius) > 2 * d;
    if (!smooth) continue;
    for (int k = 0; k < 3; ++k) {
      DVec3 e(0);
      e[k] = d;
      const FieldSample up = field.sample(p + e, list), down = field.sample(p - e, list);
      EXPECT_NEAR((up.value - down.value) / (2 * d), s.gradient[k], 1e-6);
      for (int j = 0; j < 3; ++j)
        EXPECT_NEAR((up.gradient[j] - down.gradient[j]) / (2 * d), s.hessian[k][j], 1e-5);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Kernels, Fields, testing::Values(Kernel::poly6, Kernel::wyvill, Kernel::blob, Kernel::gaussian),
    [](const auto& i) { return std::string(kKernels[static_cast<int>(i.param)]); });

}  // namespace
}  // namespace pbrt::metaballs::test
