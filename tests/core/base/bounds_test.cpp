#include "core/base/bounds.h"

#include <gtest/gtest.h>

#include "core/base/rng.h"

namespace pbrt {
namespace {

TEST(Bounds3, IsEmptyUntilAPointIsAdded) {
  Bounds3 b;
  EXPECT_TRUE(b.empty());
  EXPECT_FALSE(b.contains(Point3(0)));
  b.add(Bounds3());
  EXPECT_TRUE(b.empty());
  b.add(Point3(1, 2, 3));
  EXPECT_FALSE(b.empty());
  EXPECT_TRUE(b.contains({1, 2, 3}));
  EXPECT_EQ(b.diagonal(), Vec3(0));
  EXPECT_EQ(b.centre(), Point3(1, 2, 3));
}

TEST(Bounds3, HoldsExactlyWhatWasAdded) {
  Bounds3 b;
  b.add(Point3(-1, 0, 5));
  b.add(Point3(2, -3, 4));
  EXPECT_EQ(b.lo, Point3(-1, -3, 4));
  EXPECT_EQ(b.hi, Point3(2, 0, 5));
  for (int axis = 0; axis < 3; ++axis) {
    Point3 p = b.centre();
    p[axis] = std::nextafter(b.hi[axis], kInfinity);
    EXPECT_FALSE(b.contains(p));
    p[axis] = std::nextafter(b.lo[axis], -kInfinity);
    EXPECT_FALSE(b.contains(p));
  }
  Bounds3 both{{0, 0, 0}, {9, 9, 9}};
  both.add(b);
  EXPECT_EQ(both.lo, Point3(-1, -3, 0));
  EXPECT_EQ(both.hi, Point3(9, 9, 9));
}

TEST(Bounds3, CentreOfAHugeBoxIsFinite) {
  const float huge = std::numeric_limits<float>::max();
  EXPECT_EQ((Bounds3{Point3(huge), Point3(huge)}).centre(), Point3(huge));
}

TEST(RoundOutward, GivesTheSmallestFloatBoxAround) {
  Rng rng(1);
  for (int i = 0; i < 10000; ++i) {
    DPoint3 p;
    for (int axis = 0; axis < 3; ++axis)
      p[axis] = std::ldexp(rng.uniform() + rng.uniform() * 0x1p-24 - 0.5,
                           static_cast<int>(rng.uniform(60)) - 30);
    const Bounds3 b = roundOutward(p, p);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_LE(b.lo[axis], p[axis]);
      EXPECT_GE(b.hi[axis], p[axis]);
      EXPECT_GT(std::nextafter(b.lo[axis], kInfinity), p[axis]);
      EXPECT_LT(std::nextafter(b.hi[axis], -kInfinity), p[axis]);
    }
  }
}

TEST(RoundOutward, KeepsFloatsAndHoldsWhatFloatCannot) {
  const Bounds3 same = roundOutward({0.5, -2, 0}, {0.5, -2, 0});
  EXPECT_EQ(same.lo, Point3(0.5F, -2, 0));
  EXPECT_EQ(same.hi, Point3(0.5F, -2, 0));
  const Bounds3 big = roundOutward(DPoint3(-1e300), DPoint3(1e300));
  EXPECT_EQ(big.lo, Point3(-kInfinity));
  EXPECT_EQ(big.hi, Point3(kInfinity));
  const Bounds3 tiny = roundOutward(DPoint3(-1e-300), DPoint3(1e-300));
  EXPECT_LT(tiny.lo.x, 0);
  EXPECT_GT(tiny.hi.x, 0);
  EXPECT_EQ(roundOutward(DPoint3(1e300), DPoint3(1e300)).lo.x, std::numeric_limits<float>::max());
}

TEST(Bounds2i, IsHalfOpen) {
  const Bounds2i b{{1, 2}, {4, 4}};
  int inside = 0;
  for (int y = 0; y < 6; ++y)
    for (int x = 0; x < 6; ++x) inside += b.contains({x, y});
  EXPECT_EQ(inside, b.width() * b.height());
  EXPECT_TRUE(b.contains({1, 2}));
  EXPECT_FALSE(b.contains({4, 3}));
  EXPECT_FALSE(b.contains({3, 4}));
  EXPECT_TRUE(Bounds2i().empty());
  EXPECT_TRUE((Bounds2i{{3, 0}, {2, 9}}).empty());
}

TEST(Bounds2i, IntersectionHoldsWhatBothHold) {
  Rng rng(3);
  const auto box = [&] {
    const auto number = [&] { return static_cast<int>(rng.uniform(8)); };
    const Point2i lo(number(), number());
    return Bounds2i{lo, lo + Point2i(number(), number())};
  };
  for (int i = 0; i < 300; ++i) {
    const Bounds2i a = box();
    const Bounds2i b = box();
    const Bounds2i both = intersect(a, b);
    bool any = false;
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 16; ++x) {
        EXPECT_EQ(both.contains({x, y}), a.contains({x, y}) && b.contains({x, y}));
        any = any || both.contains({x, y});
      }
    EXPECT_EQ(both.empty(), !any);
  }
}

}  // namespace
}  // namespace pbrt
