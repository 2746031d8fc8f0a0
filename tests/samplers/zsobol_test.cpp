#include "tests/samplers/drawing.h"

namespace pbrt {
namespace {

using test::draw;
using test::isNet;
using test::sampler;

TEST(ZSobolSampler, EveryPixelHasANet) {
  for (const std::uint32_t n : {1U, 2U, 8U, 16U, 128U}) {
    const auto s = sampler("zsobol", {}, static_cast<int>(n));
    for (const Point2i pixel : {Point2i(0), Point2i(5, 77), Point2i(-1, 300), Point2i(70000, 2)})
      for (const int d : {0, 1, 2, 25})
        for (std::uint32_t round = 0; round < 3; ++round)
          EXPECT_TRUE(isNet(draw(*s, pixel, d, round * n, (round + 1) * n))) << n << ' ' << d;
  }
}

// The first quarter, a quarter of that, and so on.
TEST(ZSobolSampler, BeginningsOfAPixelAreNets) {
  for (const int count : {256, 200}) {
    const auto s = sampler("zsobol", {}, count);
    const auto points = draw(*s, {3, 5}, 0, 0, static_cast<std::uint32_t>(count));
    for (std::size_t n = 1; n <= points.size(); n *= 4)
      EXPECT_TRUE(isNet(std::span(points).first(n))) << n << " of " << count;
  }
}

// What makes neighbours' errors cancel: aligned blocks of 2^k by 2^k pixels have a net together.
TEST(ZSobolSampler, BlocksOfPixelsHaveANetTogether) {
  for (const std::uint32_t n : {1U, 4U, 8U})
    for (const int side : {2, 4, 16}) {
      const auto s = sampler("zsobol", {}, static_cast<int>(n));
      for (const Point2i block : {Point2i(0), Point2i(16, 112), Point2i(-16, 1024)})
        for (const int d : {0, 1, 7}) {
          std::vector<Point2> points;
          for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x)
              for (const Point2& p : draw(*s, block + Point2i(x, y), d, 0, n)) points.push_back(p);
          EXPECT_TRUE(isNet(points)) << n << " samples of " << side << " by " << side;
        }
    }
}

// Quarters of a block are dealt to their pixels in all 24 orders.
TEST(ZSobolSampler, OrdersOfTheFourPixelsOfABlockAreRandom) {
  const auto s = sampler("zsobol", {}, 1);
  std::array<int, 256> orders{};
  constexpr int blocks = 24000;
  for (int block = 0; block < blocks; ++block) {
    std::size_t order = 0;
    for (int i = 0; i < 4; ++i) {
      s->start({2 * (block % 200) + i % 2, 2 * (block / 200) + i / 2}, 0);
      order = order * 4 + static_cast<std::size_t>(s->pixel2D().x * 4);
    }
    ++orders[order];
  }
  // Two of the six linear maps are twice as likely as the others.
  EXPECT_EQ(std::count(orders.begin(), orders.end(), 0), 256 - 24);
  EXPECT_LT(*std::max_element(orders.begin(), orders.end()), blocks / 16 * 1.15);
}

TEST(ZSobolSampler, SetsAreNetsAloneAndTogether) {
  const auto s = sampler("zsobol", {}, 16);
  for (const std::size_t n : {std::size_t{1}, std::size_t{4}, std::size_t{32}}) {
    const auto points = test::drawSets(*s, {4, 4}, n, 16);
    for (std::size_t i = 0; i < 16; ++i) EXPECT_TRUE(isNet(std::span(points).subspan(i * n, n)));
    EXPECT_TRUE(isNet(points)) << n;
  }
}

TEST(ZSobolSampler, RandomizationIsWhatTheSceneSays) {
  const auto points = [](const char* how) {
    return draw(*sampler("zsobol", {test::text("randomization", how)}, 16), {3, 3}, 1, 0, 16);
  };
  EXPECT_EQ(points("owen"), points("fastowen"));
  EXPECT_NE(points("owen"), points("permutedigits"));
  // Without it, coordinates are multiples of one over all samples of the block.
  for (const Point2& p : points("none")) EXPECT_EQ(p.x * 0x1p18F, std::floor(p.x * 0x1p18F));
  for (const char* how : {"none", "permutedigits"}) EXPECT_TRUE(isNet(points(how))) << how;
}

TEST(ZSobolSampler, DefaultIsSixteenSamplesOfAnyCount) {
  EXPECT_EQ(sampler("zsobol")->samplesPerPixel(), 16);
  EXPECT_EQ(sampler("zsobol", {test::integers("pixelsamples", {100})})->samplesPerPixel(), 100);
}

}  // namespace
}  // namespace pbrt
