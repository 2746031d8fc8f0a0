// How much of a surface surfels cover: against closed forms and a search of all pairs.

#include "shapes/metaballs/surfels/coverage.h"

#include <gtest/gtest.h>

#include "core/base/parallel.h"
#include "core/base/rng.h"
#include "core/base/warp.h"

namespace pbrt::surfels {
namespace {

// f = 1 - r^2 about the origin: |grad f| = 2 on the surface. Its seeds are anywhere within.
class Ball final : public MovingField {
 public:
  Bounds3 bounds() const override { return {Point3(-1), Point3(1)}; }
  double grain() const override { return 1; }
  void at(std::span<const DPoint3> points, std::span<FieldAt> out) const override {
    for (std::size_t i = 0; i < points.size(); ++i)
      out[i] = {1 - lengthSquared(points[i]), -2.0 * points[i]};
  }
  void shape(std::span<const DPoint3>, std::span<ShapeAt>) const override {}
  bool seeds(std::uint64_t first, std::span<DPoint3> out) const override {
    for (DPoint3& p : out) {
      Rng rng(first++);
      p = double{rng.uniform()} * DVec3(uniformSphere({rng.uniform(), rng.uniform()}));
    }
    return true;
  }
};

class Nothing final : public MovingField {
 public:
  Bounds3 bounds() const override { return {}; }
  double grain() const override { return 1; }
  void at(std::span<const DPoint3>, std::span<FieldAt> out) const override {
    std::ranges::fill(out, FieldAt());
  }
  void shape(std::span<const DPoint3>, std::span<ShapeAt>) const override {}
  bool seeds(std::uint64_t, std::span<DPoint3>) const override { return false; }
};

// A disc at p of the unit sphere.
Surfel disc(const DVec3& p, float radius) {
  Surfel s;
  s.p = p;
  s.n = Normal3(p);
  s.radius = radius;
  return s;
}

std::vector<Surfel> randomDiscs(int count, float radius) {
  Rng rng(5);
  std::vector<Surfel> discs;
  for (int i = 0; i < count; ++i)
    discs.push_back(disc(DVec3(uniformSphere({rng.uniform(), rng.uniform()})), radius));
  return discs;
}

TEST(Coverage, PlacesAreOnTheSurface) {
  const std::vector<Place> found = places(Ball(), 7, 5000);
  EXPECT_GT(found.size(), 4990U);  // all but seeds at the very centre
  for (const Place& place : found) {
    EXPECT_NEAR(glm::length(place.p), 1, 5e-5);
    EXPECT_NEAR(glm::dot(glm::normalize(place.p), DVec3(place.n)), 1, 1e-6);
  }
  EXPECT_TRUE(places(Nothing(), 0, 100).empty());
}

// A sphere's points within a chord c of one of them are the share c^2 / 4 of its area (Archimedes).
TEST(Coverage, OfOneDiscIsItsShareOfTheArea) {
  const std::vector<Place> found = places(Ball(), 0, 40000);
  for (const float c : {0.2F, 0.7F, 1.2F}) {
    const std::vector<Surfel> one{disc({0, 0, 1}, c)};
    const double share = sqr(c) / 4, error = std::sqrt(share * (1 - share) / 40000);
    EXPECT_NEAR(coverage(one, found, 0).covered, share, 4.5 * error) << c;
    EXPECT_NEAR(coverage(one, found, c).near, share, 4.5 * error) << c;
    EXPECT_EQ(coverage(one, found, 0).near, 0) << c;
  }
}

TEST(Coverage, IsThatOfAllPairs) {
  std::vector<Place> found = places(Ball(), 0, 2000);
  for (std::size_t i = 0; i < found.size(); ++i) found[i].weight = 1 + static_cast<double>(i % 3);
  std::vector<Surfel> discs = randomDiscs(1000, 0);
  for (std::size_t i = 0; i < discs.size(); ++i)
    discs[i].radius = 0.02F * static_cast<float>(i % 4);
  constexpr double within = 0.05;
  double covered = 0, near = 0, all = 0;
  for (const Place& place : found) {
    bool isCovered = false, isNear = false;
    for (const Surfel& s : discs) {
      const double d = glm::length(s.p - place.p);
      isCovered |= d <= s.radius;
      isNear |= d <= within;
    }
    all += place.weight;
    if (isCovered) covered += place.weight;
    if (isNear) near += place.weight;
  }
  const Coverage c = coverage(discs, found, within);
  EXPECT_NEAR(c.covered, covered / all, 1e-12);
  EXPECT_NEAR(c.near, near / all, 1e-12);
  EXPECT_GT(c.covered, 0.1);
  EXPECT_LT(c.covered, 0.9);

  const ThreadLimit limit(1);
  const Coverage alone = coverage(discs, found, within);
  EXPECT_EQ(alone.covered, c.covered);
  EXPECT_EQ(alone.near, c.near);
}

TEST(Coverage, DiscsOfTheOtherSheetDoNotCount) {
  const std::vector<Place> found = places(Ball(), 0, 500);
  std::vector<Surfel> discs = randomDiscs(2000, 0.3F);
  EXPECT_EQ(coverage(discs, found, 0.3).covered, 1);
  for (Surfel& s : discs) s.n = -s.n;
  EXPECT_EQ(coverage(discs, found, 0.3).covered, 0);
  EXPECT_EQ(coverage(discs, found, 0.3).near, 0);
}

TEST(Coverage, OfNothingIsAllAndByNothingIsNone) {
  EXPECT_EQ(coverage(randomDiscs(10, 1), {}, 1).covered, 1);
  EXPECT_NEAR(coverage({}, places(Ball(), 0, 10), 1).covered, 0, 1e-12);
  std::vector<Surfel> broken = randomDiscs(10, 3);
  for (Surfel& s : broken) s.p.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(coverage(broken, places(Ball(), 0, 10), 1).covered, 0);
}

}  // namespace
}  // namespace pbrt::surfels
