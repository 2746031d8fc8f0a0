#include "tests/samplers/drawing.h"

namespace pbrt {
namespace {

using test::draw;
using test::evenlyShared;
using test::integers;
using test::sampler;

struct Grid {
  int x, y;
};

class StratifiedSampler : public testing::TestWithParam<Grid> {
 protected:
  std::unique_ptr<Sampler> make(bool jitter = true) const {
    return sampler("stratified",
                   {integers("xsamples", {GetParam().x}), integers("ysamples", {GetParam().y}),
                    test::flag("jitter", jitter), integers("dimensions", {2})});
  }
  std::uint32_t count() const { return static_cast<std::uint32_t>(GetParam().x * GetParam().y); }
};

INSTANTIATE_TEST_SUITE_P(Grids, StratifiedSampler,
                         testing::Values(Grid{1, 1}, Grid{4, 4}, Grid{2, 2}, Grid{3, 5}, Grid{1, 7},
                                         Grid{16, 1}));

TEST_P(StratifiedSampler, EachSampleHasItsCellInEveryDimensionAndRound) {
  const auto s = make();
  ASSERT_EQ(s->samplesPerPixel(), static_cast<int>(count()));
  for (int pixel = 0; pixel < 20; ++pixel)
    for (int d = 0; d < 6; ++d)
      for (std::uint32_t round = 0; round < 3; ++round) {
        const auto points = draw(*s, {pixel, 3}, d, round * count(), (round + 1) * count());
        EXPECT_TRUE(evenlyShared(points, GetParam().x, GetParam().y)) << d;
      }
}

TEST_P(StratifiedSampler, OneDimensionHasAsManyStrataAsSamples) {
  const auto s = make();
  std::vector<Point2> line;
  for (std::uint32_t i = 0; i < count(); ++i) {
    s->start({8, 9}, i);
    s->pixel2D();
    line.emplace_back(s->get1D(), 0.F);
  }
  EXPECT_TRUE(evenlyShared(line, static_cast<int>(count()), 1));
}

TEST_P(StratifiedSampler, WithoutJitterSamplesAreCellCentres) {
  const auto s = make(false);
  for (const Point2& p : draw(*s, {5, 6}, 2, 0, count())) {
    const Point2 inCell = p * Point2(GetParam().x, GetParam().y);
    EXPECT_NEAR(inCell.x - std::floor(inCell.x), 0.5F, 1e-4F);
    EXPECT_NEAR(inCell.y - std::floor(inCell.y), 0.5F, 1e-4F);
  }
}

// A set of 6 lies in a grid of 2 by 3, all sets of the pixel in one as many times finer.
TEST_P(StratifiedSampler, SetsAreStratifiedAloneAndTogether) {
  const auto s = make();
  const auto points = test::drawSets(*s, {2, 3}, 6, count());
  for (std::uint32_t i = 0; i < count(); ++i)
    EXPECT_TRUE(evenlyShared(std::span(points).subspan(6 * i, 6), 2, 3));
  EXPECT_TRUE(evenlyShared(points, 2 * GetParam().x, 3 * GetParam().y));
}

TEST(StratifiedSamplerCount, CommandLineCountIsMadeOfTheNearestFactors) {
  for (const auto& [count, grid] : {std::pair{12, Grid{3, 4}}, {36, {6, 6}}, {7, {1, 7}}}) {
    const auto s = sampler("stratified", {}, count);
    EXPECT_EQ(s->samplesPerPixel(), count);
    EXPECT_TRUE(
        evenlyShared(draw(*s, {}, 1, 0, static_cast<std::uint32_t>(count)), grid.x, grid.y));
  }
}

TEST(StratifiedSamplerCount, ProductsBeyondIntegersAreErrors) {
  EXPECT_THROW(
      sampler("stratified", {integers("xsamples", {100000}), integers("ysamples", {100000})}),
      Error);
  EXPECT_NO_THROW(
      sampler("stratified", {integers("xsamples", {40000}), integers("ysamples", {40000})}));
}

}  // namespace
}  // namespace pbrt
