#include "core/api/light_tree.h"

#include <gtest/gtest.h>

#include <memory>

#include "core/base/rng.h"
#include "core/base/warp.h"
#include "tests/chi_square.h"

namespace pbrt::test {
namespace {

// A light that is nothing but its bounds.
class Bounded final : public Light {
 public:
  explicit Bounded(const LightBounds& bounds) : bounds_(bounds) {}
  LightSample sample(const Point3&, Point2) const override { return {}; }
  double power(double) const override { return bounds_.intensity; }
  LightBounds bounds() const override { return bounds_; }

 private:
  LightBounds bounds_;
};

class Lights {
 public:
  void add(const LightBounds& bounds) {
    owned_.push_back(std::make_unique<Bounded>(bounds));
    lights_.push_back(owned_.back().get());
  }
  std::size_t size() const { return lights_.size(); }
  LightTree tree() const { return LightTree(lights_); }

 private:
  std::vector<std::unique_ptr<Light>> owned_;
  std::vector<const Light*> lights_;
};

Vec3 direction(Rng& rng) {
  return uniformSphere({rng.uniform(), rng.uniform()});
}

// Points, spots and areas of all sizes and brightnesses.
Lights scattered(int n, Rng& rng) {
  Lights lights;
  for (int i = 0; i < n; ++i) {
    LightBounds b;
    const Point3 p = 10.F * direction(rng);
    b.box.add(p);
    b.intensity = std::exp(6 * rng.uniform());
    if (i % 3 > 0) b.normals = {direction(rng), 2 * rng.uniform() - 1};
    if (i % 3 == 2) {
      b.box.add(p + 2.F * direction(rng));
      b.cosEmission = 0;
      b.twoSided = i % 2;
    }
    lights.add(b);
  }
  return lights;
}

LightBounds pointAt(const Point3& p, double intensity) {
  return {{p, p}, intensity};
}

TEST(LightTree, ChoosesWithTheChancesItStates) {
  Rng rng(1);
  for (const int n : {1, 2, 7, 60}) {
    Lights lights = scattered(n, rng);
    if (n == 60) {
      lights.add({{}, 0.1});
      lights.add({{}, 5});
    }
    lights.add(pointAt(Point3(0), 0));  // black
    const LightTree tree = lights.tree();
    for (int k = 0; k < 5; ++k) {
      const Point3 p = 15 * rng.uniform() * direction(rng);
      const Normal3 normal = k == 0 ? Normal3(0) : direction(rng);
      constexpr int draws = 50000;
      std::vector<double> counts(lights.size());
      for (int i = 0; i < draws; ++i) {
        const auto chosen = tree.choose(p, normal, rng.uniform());
        ASSERT_TRUE(chosen.rest >= 0 && chosen.rest < 1);
        ASSERT_NEAR(chosen.chance, tree.chance(p, normal, chosen.light), 1e-12);
        ++counts[chosen.light];
      }
      double sum = 0;
      std::vector<double> seen, expected;
      for (std::uint32_t i = 0; i < lights.size(); ++i) {
        const double chance = tree.chance(p, normal, i);
        sum += chance;
        if (chance == 0) {
          EXPECT_EQ(counts[i], 0);
        }
        if (chance * draws < 5) continue;
        seen.push_back(counts[i]);
        expected.push_back(chance * draws);
      }
      EXPECT_NEAR(sum, 1, 1e-6);
      if (seen.size() > 1) {
        EXPECT_LT(chiSquareDeviation(seen, expected), 4.5) << n;
      }
    }
  }
}

// What is left of the number is uniform, for the light to sample with.
TEST(LightTree, TheRestIsUniformStill) {
  Lights lights;
  for (int i = 0; i < 4; ++i) lights.add(pointAt({i % 2, i / 2, 0}, 1));
  const LightTree tree = lights.tree();
  constexpr int cells = 64, draws = 100000;
  std::vector<double> counts(cells);
  Rng rng(2);
  for (int i = 0; i < draws; ++i)
    ++counts[static_cast<std::size_t>(tree.choose({0.4F, 0.7F, 1}, Normal3(0), rng.uniform()).rest *
                                      cells)];
  EXPECT_LT(uniformDeviation(counts), 4.5);
}

// Of two points the chances are as the irradiances that they send.
TEST(LightTree, TwoPointsShareByTheirIrradiance) {
  Lights lights;
  lights.add(pointAt({0, 0, 1}, 2));
  lights.add(pointAt({3, 0, 4}, 50));
  // 2 / 1, and 50 / 25 at a cosine of 0.8.
  EXPECT_NEAR(lights.tree().chance(Point3(0), {0, 0, 1}, 0), 2 / (2 + 1.6), 1e-6);
  EXPECT_NEAR(lights.tree().chance(Point3(0), Normal3(0), 0), 0.5, 1e-6);
}

TEST(LightTree, WhatCannotSendLightIsNotChosen) {
  Lights lights;
  lights.add(pointAt({0, 0, 1}, 1e-20));
  lights.add(pointAt({0, 0, -1}, 1e20));                                // behind
  lights.add({{{1, 0, 1}, {1.1F, 0.1F, 1}}, 1e20, {{0, 0, 1}, 1}, 0});  // shines up
  const LightTree tree = lights.tree();
  EXPECT_EQ(tree.chance(Point3(0), {0, 0, 1}, 0), 1);
  EXPECT_GT(tree.chance(Point3(0), Normal3(0), 1), 0.99);
}

// Two spots and another one far away, all turned alike: the two belong together, though there is
// nothing between them. Under a node each, the one that the far one shares its node with would have
// the chance of that node as a whole.
TEST(LightTree, GapsDoNotPartNeighbours) {
  Lights lights;
  for (const Point3 p : {Point3(0), Point3(3, 0.1F, 0), Point3(10, 0.2F, 0)})
    lights.add({{p, p}, 1, {{0, 0, 1}, 0.5F}});
  const LightTree tree = lights.tree();
  const Point3 between(1.5F, 0.05F, 1);
  EXPECT_NEAR(tree.chance(between, Normal3(0), 0), 0.5, 1e-5);
  EXPECT_NEAR(tree.chance(between, Normal3(0), 1), 0.5, 1e-5);
}

TEST(LightTree, NeitherTheNearNorTheFarIsLeftOut) {
  Lights lights;
  lights.add(pointAt({0, 0, 1}, 1));
  lights.add({{}, 1e9});
  EXPECT_DOUBLE_EQ(lights.tree().chance(Point3(0), Normal3(0), 0), 0.1);
  EXPECT_DOUBLE_EQ(lights.tree().chance({0, 0, 0.99999F}, Normal3(0), 1), 0.1);
}

TEST(LightTree, BlackLightsMakeNoTree) {
  EXPECT_TRUE(LightTree().empty());
  Lights lights;
  lights.add(pointAt({0, 0, 1}, 0));
  EXPECT_TRUE(lights.tree().empty());
}

// All in one place, and each ten times as far as the one before: no tree gets deep enough to
// matter.
TEST(LightTree, OddPlaces) {
  Rng rng(3);
  Lights heap, flung;
  for (int i = 0; i < 20000; ++i) heap.add(pointAt({1, 2, 3}, 1));
  for (int i = 0; i < 200; ++i)
    flung.add(pointAt(std::pow(10.F, static_cast<float>(i % 36) - 18) * direction(rng), 1));
  EXPECT_NEAR(heap.tree().chance(Point3(0), Normal3(0), 7), 1 / 20000.0, 1e-6 / 20000);
  const LightTree tree = flung.tree();
  for (const float scale : {0.F, 1e-18F, 1.F, 1e18F}) {
    double sum = 0;
    const Point3 p = scale * direction(rng);
    for (std::uint32_t i = 0; i < flung.size(); ++i) sum += tree.chance(p, Normal3(0), i);
    EXPECT_NEAR(sum, 1, 1e-6) << scale;
  }
}

}  // namespace
}  // namespace pbrt::test
