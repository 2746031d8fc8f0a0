#include "tests/samplers/drawing.h"

namespace pbrt {
namespace {

using test::draw;
using test::evenlyShared;
using test::integers;
using test::sampler;

// Any b^k consecutive samples that begin at a multiple of b^k have one each in b^k intervals, in
// the dimension with base b; in two dimensions likewise for boxes.
TEST(HaltonSampler, BoxesOfThePrimesHoldOneSampleEach) {
  const auto s = sampler("halton", {}, 2 * 3 * 36 * 25);
  for (int pixel = 0; pixel < 20; ++pixel) {
    for (const auto& [columns, rows] : {std::pair{2, 3}, {4, 9}, {8, 3}, {1, 27}, {8, 27}}) {
      const auto n = static_cast<std::uint32_t>(columns * rows);
      for (const std::uint32_t begin : {0U, n, 5 * n})
        EXPECT_TRUE(evenlyShared(draw(*s, {pixel, 1}, 0, begin, begin + n), columns, rows)) << n;
    }
    for (const auto& [columns, rows] : {std::pair{5, 7}, {25, 1}, {25, 7}, {1, 49}}) {
      const auto n = static_cast<std::uint32_t>(columns * rows);
      EXPECT_TRUE(evenlyShared(draw(*s, {pixel, 1}, 1, 0, n), columns, rows)) << n;
    }
  }
}

TEST(HaltonSampler, SetsTogetherAreOneSequence) {
  const auto s = sampler("halton", {}, 7);
  const auto points = test::drawSets(*s, {1, 1}, 11, 7);  // bases 7 and 11
  EXPECT_TRUE(evenlyShared(points, 7, 11));
  for (std::size_t i = 0; i < 7; ++i)
    EXPECT_TRUE(evenlyShared(std::span(points).subspan(11 * i, 11), 1, 11));
}

// The digits of different pixels go through different permutations.
TEST(HaltonSampler, PixelsAreScrambledDifferently) {
  const auto s = sampler("halton", {}, 9);
  std::vector<std::vector<int>> orders;
  for (int pixel = 0; pixel < 50; ++pixel) {
    std::vector<int> order;
    for (const Point2& p : draw(*s, {pixel, 1}, 0, 0, 9))
      order.push_back(static_cast<int>(p.y * 9));
    orders.push_back(order);
  }
  std::sort(orders.begin(), orders.end());
  EXPECT_GT(std::unique(orders.begin(), orders.end()) - orders.begin(), 40);
}

// Base 3: digits may stay, or be permuted, or be permuted by what comes before them.
TEST(HaltonSampler, RandomizationIsWhatTheSceneSays) {
  const auto ninths = [](const char* how, int pixel) {
    std::array<int, 9> all{};
    const auto s = sampler("halton", {test::text("randomization", how)}, 9);
    const auto points = draw(*s, {pixel, 1}, 0, 0, 9);
    for (std::size_t i = 0; i < 9; ++i) all[i] = static_cast<int>(points[i].y * 9);
    return all;
  };
  bool differ = false, nested = false;
  for (int pixel = 0; pixel < 10; ++pixel) {
    const auto none = ninths("none", pixel), permuted = ninths("permutedigits", pixel),
               owen = ninths("owen", pixel);
    for (std::size_t i = 0; i < 9; ++i) {
      // The sequence counts its first ternary digit up, from some element on.
      EXPECT_EQ(none[i] / 3, (none[0] / 3 + static_cast<int>(i)) % 3);
      // The second digits of samples 3 apart are those of the first three, permuted alike.
      EXPECT_EQ(permuted[i] % 3, permuted[i - i % 3] % 3);
      nested |= owen[i] % 3 != owen[i - i % 3] % 3;
    }
    differ |= none != ninths("none", pixel + 1);
    EXPECT_EQ(owen, ninths("fastowen", pixel));
  }
  EXPECT_TRUE(differ);
  EXPECT_TRUE(nested);
}

TEST(HaltonSampler, PixelCentreOnDemandLeavesTheOtherDimensionsAlone) {
  const auto s = sampler("halton");
  const auto centred = sampler("halton", {test::flag("samplepixelcenter", true)});
  EXPECT_EQ(s->samplesPerPixel(), 16);
  for (std::uint32_t i = 0; i < 16; ++i) {
    s->start({5, 5}, i);
    centred->start({5, 5}, i);
    s->pixel2D();
    EXPECT_EQ(centred->pixel2D(), Point2(0.5F));
    EXPECT_EQ(centred->get2D(), s->get2D());
  }
}

TEST(HaltonSampler, DimensionsNeverRunOut) {
  const auto s = sampler("halton");
  for (std::uint32_t i = 0; i < 4; ++i) {
    s->start({5, 5}, i);
    float last = -1;
    for (int d = 0; d < 1000; ++d) {
      const float u = s->get1D();
      EXPECT_TRUE(u >= 0 && u < 1 && u != last);
      last = u;
    }
  }
}

}  // namespace
}  // namespace pbrt
