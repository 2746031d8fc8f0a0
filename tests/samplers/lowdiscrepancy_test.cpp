#include "tests/samplers/drawing.h"

namespace pbrt {
namespace {

using test::draw;
using test::evenlyShared;
using test::integers;
using test::isNet;
using test::sampler;

TEST(LowDiscrepancySampler, EveryBeginningOfAPixelIsANet) {
  const auto s = sampler("lowdiscrepancy", {}, 256);
  for (int pixel = 0; pixel < 10; ++pixel) {
    const auto points = draw(*s, {pixel, 5}, 0, 0, 256);
    for (std::size_t n = 1; n <= 256; n *= 2)
      EXPECT_TRUE(isNet(std::span(points).first(n))) << n << " of pixel " << pixel;
    for (std::size_t begin = 0; begin < 256; begin += 16)
      EXPECT_TRUE(isNet(std::span(points).subspan(begin, 16))) << begin;
  }
}

TEST(LowDiscrepancySampler, EveryDimensionOfAPixelIsANet) {
  for (const std::uint32_t n : {1U, 2U, 16U, 128U}) {
    const auto s = sampler("lowdiscrepancy", {}, static_cast<int>(n));
    for (int pixel = 0; pixel < 20; ++pixel)
      for (int d = 0; d < 8; ++d)
        for (std::uint32_t round = 0; round < 3; ++round)
          EXPECT_TRUE(isNet(draw(*s, {pixel, -2}, d, round * n, (round + 1) * n)));
  }
}

TEST(LowDiscrepancySampler, SetsAreNetsAloneAndTogether) {
  const auto s = sampler("lowdiscrepancy", {}, 16);
  for (const std::size_t n : {std::size_t{1}, std::size_t{4}, std::size_t{32}}) {
    const auto points = test::drawSets(*s, {4, 4}, n, 16);
    for (std::size_t i = 0; i < 16; ++i) EXPECT_TRUE(isNet(std::span(points).subspan(i * n, n)));
    EXPECT_TRUE(isNet(points)) << n;
  }
  // Of a set of 5, as of 8, no two share an eighth.
  const auto five = test::drawSets(*s, {4, 4}, 5, 1);
  std::array<int, 8> eighths{};
  for (const Point2& p : five) EXPECT_EQ(++eighths[static_cast<std::size_t>(p.x * 8)], 1);
}

TEST(LowDiscrepancySampler, CountIsRoundedUpToAPowerOfTwoAndSaysSo) {
  EXPECT_EQ(sampler("lowdiscrepancy")->samplesPerPixel(), 16);
  EXPECT_EQ(sampler("lowdiscrepancy", {}, 5)->samplesPerPixel(), 8);
  EXPECT_EQ(sampler("lowdiscrepancy", {integers("pixelsamples", {64})})->samplesPerPixel(), 64);
  std::vector<std::string> warnings;
  const ParamList list = {integers("pixelsamples", {100}), integers("dimensions", {4})};
  Params params("lowdiscrepancy", {}, {&list}, nullptr,
                [&](const Diagnostic& d) { warnings.push_back(d.message); });
  const auto s = create<Sampler>(test::loader().open(PluginKind::sampler, "lowdiscrepancy"), params,
                                 Sampler::Setup{});
  EXPECT_EQ(s->samplesPerPixel(), 128);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("128"), std::string::npos);
}

}  // namespace
}  // namespace pbrt
