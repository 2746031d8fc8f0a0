#include "tests/chi_square.h"
#include "tests/samplers/drawing.h"

namespace pbrt {
namespace {

using test::integers;
using test::sampler;

TEST(RandomSampler, TakesItsCountFromEitherPbrt) {
  EXPECT_EQ(sampler("random")->samplesPerPixel(), 4);
  EXPECT_EQ(sampler("random", {integers("pixelsamples", {7})})->samplesPerPixel(), 7);
  EXPECT_EQ(
      sampler("random", {integers("xsamples", {3}), integers("ysamples", {5})})->samplesPerPixel(),
      15);
  EXPECT_THROW(sampler("random", {integers("xsamples", {100000}), integers("ysamples", {100000})}),
               Error);
}

// The samples of one pixel, not one sample of many pixels.
TEST(RandomSampler, SamplesOfAPixelAreIndependent) {
  const auto s = sampler("random");
  std::vector<double> single(256), pairs(256);
  const auto cell = [](float u) { return static_cast<std::size_t>(u * 16); };
  float last = 0;
  for (std::uint32_t i = 0; i < 60000; ++i) {
    s->start({1, 1}, i);
    const Point2 p = s->pixel2D();
    ++single[cell(p.x) * 16 + cell(p.y)];
    if (i % 2) ++pairs[cell(last) * 16 + cell(p.x)];
    last = p.x;
  }
  EXPECT_LT(test::uniformDeviation(single), 4);
  EXPECT_LT(test::uniformDeviation(pairs), 4);
}

}  // namespace
}  // namespace pbrt
