// The first crossing against the oracle, and the oracle against what is known without it.

#include "shapes/metaballs/roots.h"

#include <gtest/gtest.h>

#include "tests/shapes/metaballs/sets.h"

namespace pbrt::metaballs::test {
namespace {

// K = 1/8 on the surface of a wyvill atom of weight 8: r^2 = h^2 / 2.
TEST(TheOracle, FindsABall) {
  const Field field(Kernel::wyvill, {atom(Kernel::wyvill, {1, 2, 3}, 2, 8)});
  Random random(1);
  int hits = 0;
  for (int i = 0; i < 300; ++i) {
    const DVec3 d = random.direction();
    const ObjectRay ray{DPoint3(1, 2, 3) + 1.6 * random.cube() - random.in(0, 1e4) * d, d};
    const DVec3 v = DPoint3(1, 2, 3) - ray.o;
    const auto root = Oracle(field, ray).first();
    const double miss = glm::length(v - glm::dot(v, d) / glm::dot(d, d) * d) / std::sqrt(2);
    if (std::abs(miss - 1) > 1e-9 && glm::length(v) > 3) {
      EXPECT_EQ(root.has_value(), miss < 1);
    }
    if (!root) continue;
    Quad r2 = 0;
    for (int k = 0; k < 3; ++k) {
      const Quad x = ray.o[k] + root->t * ray.d[k] - (k + 1);
      r2 += x * x;
    }
    EXPECT_LT(static_cast<double>(abs(r2 - 2)), 1e-24);
    ++hits;
  }
  EXPECT_GT(hits, 100);
}

// Samples keep to one side up to the root; the field changes sign there.
TEST(TheOracle, NamesTheFirstChangeOfSign) {
  for (const Kernel kernel : kAllKernels) {
    const Subject subject(cloud(12, kernel, 0.3, 1, 12));
    Random random(2);
    int hits = 0;
    for (int i = 0; i < 100; ++i) {
      const ObjectRay ray = rayAt(i % 2 ? Aim::outside : Aim::inside, subject, random);
      Oracle oracle(subject.blocks, ray);
      const auto root = oracle.first();
      const Quad end = root ? root->t : Quad(30 / glm::length(ray.d));
      const bool inside = oracle.value(0) > 0;
      for (int k = 1; k < 300; ++k) EXPECT_EQ(oracle.value(end * k / 300) > 0, inside);
      if (!root) continue;
      EXPECT_FALSE(root->touch);
      EXPECT_EQ(oracle.value(end - Quad(1e-24)) > 0, inside);
      EXPECT_NE(oracle.value(end + Quad(1e-24)) > 0, inside);
      ++hits;
    }
    EXPECT_GT(hits, 30);
  }
}

TEST(TheJudge, TellsWrongAnswers) {
  const Subject subject(cloud(12, Kernel::wyvill, 0.3, 1, 12));
  Random random(3);
  Tally right, late, early, none, invented, unlike;
  for (int i = 0; i < 200; ++i) {
    const ObjectRay ray = rayAt(Aim::outside, subject, random);
    const auto t = subject.first(ray);
    Judge judge(subject.blocks, ray);
    judge(t, t.has_value(), right);
    judge(t, !t, unlike);
    if (!t) {
      judge(3, true, invented);
      continue;
    }
    judge(*t + 1e-6, true, late);
    judge(*t - 1e-6, true, early);
    judge({}, false, none);
  }
  EXPECT_TRUE(right.good());
  EXPECT_EQ(unlike.split, unlike.rays);
  EXPECT_EQ(late.missed, late.rays);
  EXPECT_EQ(early.wrong, early.rays);
  EXPECT_EQ(none.missed, none.rays);
  EXPECT_EQ(invented.wrong, invented.rays);
  EXPECT_GT(std::min({none.rays, invented.rays}), 30U);
}

class Ordinary : public testing::TestWithParam<Set> {};

TEST_P(Ordinary, FirstCrossingIsProven) {
  Tally tally;
  for (const Kernel kernel : kAllKernels) {
    const Subject subject(GetParam().field(kernel));
    Random random(17);
    for (int i = 0; i < 2500; ++i) {
      const ObjectRay ray = GetParam().ray(subject, random);
      EXPECT_TRUE(subject.judge(ray, tally)) << digits(ray);
    }
  }
  Tally::printHeader();
  tally.print(GetParam().name);
  EXPECT_LE(tally.touches, 1U);
  EXPECT_GT(tally.hits, tally.rays / 4);
  EXPECT_LT(tally.quantile(0.5), 1e-14);
  EXPECT_LT(tally.quantile(1), 1e-8);  // from 1e6 radii away
}

INSTANTIATE_TEST_SUITE_P(Sets, Ordinary, testing::ValuesIn(ordinarySets(300)),
                         [](const auto& i) { return i.param.identifier(); });

class Crossing : public testing::TestWithParam<Kernel> {};

// Past one crossing and up to the next a ray sees nothing.
TEST_P(Crossing, KeepsToTheRaysPart) {
  const Subject subject(cloud(12, GetParam(), 0.3, 1, 12));
  Random random(33);
  int parts = 0;
  for (int i = 0; i < 300; ++i) {
    ObjectRay ray = rayAt(Aim::outside, subject, random);
    std::vector<double> all;
    while (const auto t = subject.first(ray)) {
      all.push_back(*t);
      ray.tMin = *t + 1e-9;
    }
    EXPECT_EQ(all.size() % 2, 0U);  // what enters leaves
    for (std::size_t k = 0; k + 1 < all.size(); ++k) {
      EXPECT_FALSE(subject.first({ray.o, ray.d, all[k] + 1e-9, all[k + 1] - 1e-9}));
      ++parts;
    }
  }
  EXPECT_GT(parts, 100);
}

// From a point that is on the surface but for the rounding of its coordinates.
TEST_P(Crossing, IsNotWhereTheRayStarts) {
  const Subject subject(cloud(12, GetParam(), 0.3, 1, 12));
  Random random(34);
  int starts = 0;
  for (int i = 0; i < 300; ++i) {
    const ObjectRay ray = rayAt(Aim::outside, subject, random);
    const auto t = subject.first(ray);
    if (!t || std::abs(Oracle(subject.blocks, ray).slope(*t)) < 0.1) continue;
    for (const double sign : {1.0, -1.0}) {
      const auto next = subject.first({ray.at(*t), sign * ray.d});
      EXPECT_TRUE(!next || *next > 1e-3);
    }
    ++starts;
  }
  EXPECT_GT(starts, 50);
}

// Where nearly all is undecided the search still ends soon.
TEST_P(Crossing, OfRaysThatGrazeIsCheap) {
  const Subject subject(cloud(12, GetParam(), 0, 1, 17));
  Random random(3);
  Tally tally;
  for (int i = 0; i < 1000; ++i) subject.judge(tangentRay(subject, random), tally);
  EXPECT_TRUE(tally.good());
  EXPECT_LT(static_cast<double>(tally.effort.floats) / static_cast<double>(tally.rays), 200);
}

INSTANTIATE_TEST_SUITE_P(Kernels, Crossing, testing::ValuesIn(kAllKernels), [](const auto& i) {
  return std::string(kKernels[static_cast<int>(i.param)]);
});

TEST(CrossingOfNothing, IsNone) {
  const Field field(Kernel::wyvill, {atom(Kernel::wyvill, {0, 0, 0}, 1, 2)});
  const Cells cells(field);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const ObjectRay& ray :
       {ObjectRay{{0, 0, 0.6}, {0, 0, 0}}, ObjectRay{{0, 0, -3}, {0, 0, nan}},
        ObjectRay{{0, nan, -3}, {0, 0, 1}}, ObjectRay{{0, 0, -3}, {0, 0, infinity}},
        ObjectRay{{0, 0, -3}, {0, 0, 1}, 2, 1}, ObjectRay{{0, 0, -infinity}, {0, 0, 1}}})
    for (const Cell& cell : cells.cells()) {
      EXPECT_FALSE(firstCrossing(field, cell, cells.atoms(cell), ray));
      EXPECT_FALSE(crosses(field, cell, cells.atoms(cell), ray));
    }
}

}  // namespace
}  // namespace pbrt::metaballs::test
