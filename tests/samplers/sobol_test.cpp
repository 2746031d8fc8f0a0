#include "core/base/sobol.h"

#include "tests/samplers/drawing.h"

namespace pbrt {
namespace {

using test::draw;
using test::isNet;
using test::sampler;

TEST(SobolSampler, EveryBeginningOfAPixelIsANet) {
  for (const int count : {256, 200}) {
    const auto s = sampler("sobol", {}, count);
    const auto points = draw(*s, {4, 5}, 0, 0, 256);
    for (std::size_t n = 1; n <= 256; n *= 2)
      EXPECT_TRUE(isNet(std::span(points).first(n))) << n << " of " << count;
  }
}

// Even pairs of dimensions begin a set, and begin the sequence in every round.
TEST(SobolSampler, TheFirstPairOfEachSetIsANet) {
  for (const std::uint32_t n : {1U, 2U, 16U, 128U}) {
    const auto s = sampler("sobol", {}, static_cast<int>(n));
    for (int pixel = 0; pixel < 10; ++pixel)
      for (const int d : {0, 2, 6, 30})
        for (std::uint32_t round = 0; round < 3; ++round)
          EXPECT_TRUE(isNet(draw(*s, {pixel, -2}, d, round * n, (round + 1) * n))) << n << ' ' << d;
  }
}

// Of every 16 samples one in each box that halves all four dimensions of a set, wherever it is.
TEST(SobolSampler, FourDimensionsAreSpreadTogether) {
  const auto s = sampler("sobol", {}, 64);
  for (int pixel = 0; pixel < 20; ++pixel)
    for (int set = 0; set < 5; ++set) {
      std::array<int, 16> boxes{};
      for (std::uint32_t i = 0; i < 64; ++i) {
        s->start({pixel, 0}, i);
        Point2 a = s->pixel2D(), b = s->get2D();
        for (int k = 0; k < set; ++k) a = s->get2D(), b = s->get2D();
        ++boxes[(a.x < 0.5F) * 8 + (a.y < 0.5F) * 4 + (b.x < 0.5F) * 2 + (b.y < 0.5F)];
      }
      for (const int count : boxes) EXPECT_EQ(count, 4);
    }
}

// Two numbers that are asked for together are of one set.
TEST(SobolSampler, PairsAreNetsWhateverCameBefore) {
  const auto s = sampler("sobol", {}, 16);
  std::vector<Point2> points;
  for (std::uint32_t i = 0; i < 16; ++i) {
    s->start({1, 2}, i);
    s->pixel2D();
    s->get1D();
    s->get2D();  // there was room for one more number in the set
    s->get1D();
    points.push_back((s->get1D(), s->get2D()));
  }
  EXPECT_TRUE(isNet(points));
}

TEST(SobolSampler, SetsAreNetsAloneAndTogether) {
  const auto s = sampler("sobol", {}, 16);
  for (const std::size_t n : {std::size_t{1}, std::size_t{4}, std::size_t{32}}) {
    const auto points = test::drawSets(*s, {4, 4}, n, 16);
    for (std::size_t i = 0; i < 16; ++i) EXPECT_TRUE(isNet(std::span(points).subspan(i * n, n)));
    EXPECT_TRUE(isNet(points)) << n;
  }
}

// Whether two samplers' points of a pixel differ by the same flips of digits throughout.
bool flippedAlike(std::span<const Point2> points) {
  const auto bits = [&](std::size_t i) {
    return static_cast<std::uint32_t>(points[i].x * 0x1p24F);
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto index = static_cast<std::uint32_t>(i);
    if ((bits(i) ^ bits(0)) != sobol(index, 0) >> 8U) return false;
  }
  return true;
}

TEST(SobolSampler, RandomizationIsWhatTheSceneSays) {
  const auto points = [](const char* how, int pixel) {
    return draw(*sampler("sobol", {test::text("randomization", how)}, 16), {pixel, 0}, 0, 0, 16);
  };
  for (int pixel = 0; pixel < 5; ++pixel) {
    EXPECT_TRUE(flippedAlike(points("none", pixel)));
    EXPECT_TRUE(flippedAlike(points("permutedigits", pixel)));
    EXPECT_FALSE(flippedAlike(points("owen", pixel)));
    EXPECT_EQ(points("owen", pixel), points("fastowen", pixel));
    EXPECT_EQ(points("owen", pixel), draw(*sampler("sobol", {}, 16), {pixel, 0}, 0, 0, 16));
    EXPECT_NE(points("none", pixel), points("none", pixel + 1));
  }
  EXPECT_THROW(sampler("sobol", {test::text("randomization", "much")}), Error);
}

TEST(SobolSampler, DefaultIsSixteenSamplesOfAnyCount) {
  EXPECT_EQ(sampler("sobol")->samplesPerPixel(), 16);
  EXPECT_EQ(sampler("sobol", {test::integers("pixelsamples", {100})})->samplesPerPixel(), 100);
}

}  // namespace
}  // namespace pbrt
