#include "tools/particles/look.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

namespace pbrt {
namespace {

using surfels::Fragment;

const PinholeCamera kCamera({.eye = {0, 0, -3}, .look = {}, .up = {0, 1, 0}}, {64, 64});

struct Row {
  std::vector<float> values[3];

  Row(const Look& look, int x, int y, std::span<const Fragment> seen) {
    for (auto& v : values) v.resize(seen.size());
    float* const to[] = {values[0].data(), values[1].data(), values[2].data()};
    Shader(look, kCamera).shade(x, y, seen, to);
  }
  Vec3 at(std::size_t i) const { return {values[0][i], values[1][i], values[2][i]}; }
};

// Normals all about, and now and then nothing.
std::vector<Fragment> someFragments(std::size_t n) {
  std::mt19937 random(7);
  std::normal_distribution<float> normal;
  std::vector<Fragment> seen(n);
  for (std::size_t i = 0; i < n; ++i)
    if (i % 5)
      seen[i] = {1, glm::normalize(Vec3(normal(random), normal(random), normal(random))), 0};
  return seen;
}

TEST(Look, OfAPixelDoesNotDependOnItsNeighbours) {
  const std::vector<Fragment> seen = someFragments(61);
  const Row all({}, 3, 20, seen);
  for (const std::size_t n : {1, 7, 8, 9}) {
    const Row first({}, 3, 20, std::span(seen).first(n));
    for (int c = 0; c < 3; ++c)
      EXPECT_EQ(0, std::memcmp(all.values[c].data(), first.values[c].data(), n * sizeof(float)));
  }
}

TEST(Look, IsLightAndOfTheColourAsked) {
  const std::vector<Fragment> seen = someFragments(4000);
  Look look;
  look.color = {0, 0.5F, 0};
  look.background = Vec3(0.25F, 0.5F, 4);
  const Row row(look, 0, 5, seen);
  Vec3 sum(0);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const Vec3 l = row.at(i);
    if (seen[i].t == kInfinity) {
      EXPECT_EQ(l, *look.background);
      continue;
    }
    for (int c = 0; c < 3; ++c) EXPECT_TRUE(l[c] >= 0 && l[c] < 6) << l[c];
    sum += l;
  }
  EXPECT_GT(sum.y, 1.5F * sum.x);
}

TEST(Look, LightComesFromAboveAndTheSkyIsSeenWhereThereIsNothing) {
  const std::vector<Fragment> facing{{1, {0, 0.6F, -0.8F}, 0}, {1, {0, -0.6F, -0.8F}, 0}};
  const Row row({}, 32, 32, facing);
  EXPECT_GT(row.at(0).y, 1.5F * row.at(1).y);
  const std::vector<Fragment> nothing(1);
  const Vec3 high = Row({}, 32, 0, nothing).at(0), low = Row({}, 32, 63, nothing).at(0);
  for (int c = 0; c < 3; ++c) EXPECT_GT(high[c], low[c]);
  // Straight ahead is the horizon, half way from the ground to the sky.
  const Look look;
  const Vec3 between = Row({}, 32, 31, nothing).at(0) + Row({}, 32, 32, nothing).at(0);
  EXPECT_LT(glm::distance(between, look.sky + look.ground), 1e-5F);
}

}  // namespace
}  // namespace pbrt
