#include "tests/samplers/drawing.h"

namespace pbrt {
namespace {

using test::draw;
using test::sampler;

// The mean distance to the nearest neighbour on the torus, as a part of 1 / sqrt(n). Of random
// points it is 1/2, of the densest packing 1.07.
double spread(std::span<const Point2> points) {
  double sum = 0;
  for (const Point2& p : points) {
    float nearest = 1;
    for (const Point2& q : points) {
      Point2 d = glm::abs(p - q);
      d = glm::min(d, 1.F - d);
      if (&p != &q) nearest = std::min(nearest, glm::length(d));
    }
    sum += nearest;
  }
  return sum / std::sqrt(static_cast<double>(points.size()));
}

TEST(BestCandidateSampler, EveryBeginningKeepsItsDistance) {
  const auto s = sampler("bestcandidate", {}, 1024);
  const auto points = draw(*s, {3, 3}, 0, 0, 1024);
  for (const std::size_t n : {4, 9, 16, 50, 64, 256, 1000, 1024}) {
    EXPECT_GT(spread(std::span(points).first(n)), 0.7) << n;
    EXPECT_LT(spread(std::span(points).first(n)), 1) << n;  // not a lattice
  }
}

TEST(BestCandidateSampler, DimensionsKeepTheirDistance) {
  const auto s = sampler("bestcandidate", {}, 16);
  for (int pixel = 0; pixel < 10; ++pixel)
    for (int d = 0; d < 5; ++d)
      for (std::uint32_t round = 0; round < 3; ++round)
        EXPECT_GT(spread(draw(*s, {pixel, 0}, d, round * 16, (round + 1) * 16)), 0.7);
}

TEST(BestCandidateSampler, OneDimensionIsStratified) {
  const auto s = sampler("bestcandidate", {test::integers("pixelsamples", {12})});
  std::vector<Point2> line;
  for (std::uint32_t i = 0; i < 12; ++i) {
    s->start({1, 0}, i);
    line.emplace_back(s->get1D(), 0.F);
  }
  EXPECT_TRUE(test::evenlyShared(line, 12, 1));
}

// A set has one point in each cell of a grid, and the samples of a pixel keep their distance in it.
TEST(BestCandidateSampler, SetsAreStratifiedAloneAndSpreadTogether) {
  const auto s = sampler("bestcandidate", {}, 16);
  const auto points = test::drawSets(*s, {1, 0}, 12, 16);
  std::array<std::vector<Point2>, 12> cells;
  for (std::size_t i = 0; i < 16; ++i) {
    const auto set = std::span(points).subspan(12 * i, 12);
    EXPECT_TRUE(test::evenlyShared(set, 3, 4));
    for (const Point2& p : set) {
      const Point2 scaled = p * Point2(3, 4), cell = glm::floor(scaled);
      cells[static_cast<std::size_t>(cell.y * 3 + cell.x)].push_back(scaled - cell);
    }
  }
  for (const auto& cell : cells) EXPECT_GT(spread(cell), 0.7);
}

TEST(BestCandidateSampler, DefaultIsFourSamples) {
  EXPECT_EQ(sampler("bestcandidate")->samplesPerPixel(), 4);
}

}  // namespace
}  // namespace pbrt
