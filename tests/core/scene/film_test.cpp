// The film: weights, borders between tiles, and sums that do not depend on order.

#include "core/scene/film.h"

#include "core/base/rng.h"
#include "tests/support.h"

namespace pbrt {
namespace {

// The tile that takes the samples of a pixel.
int tileOf(const Film& film, Point2i pixel) {
  for (int i = 0; i < film.tiles(); ++i)
    if (film.tilePixels(i).contains(pixel)) return i;
  ADD_FAILURE() << "no tile has pixel " << pixel.x << ' ' << pixel.y;
  return 0;
}

struct TakenSample {
  Point2 at;
  Spectrum L;
  float alpha;
};

// n random samples, anywhere where the film takes samples.
std::vector<TakenSample> randomSamples(const Film& film, int n) {
  std::vector<TakenSample> samples;
  Rng rng(7);
  const Bounds2i area = film.sampledPixels();
  for (int i = 0; i < n; ++i)
    samples.push_back({Point2(area.lo) + Point2(rng.uniform() * float(area.width()),
                                                rng.uniform() * float(area.height())),
                       {rng.uniform(), rng.uniform(), rng.uniform()},
                       rng.uniform()});
  return samples;
}

void addAll(Film& film, const std::vector<TakenSample>& samples) {
  for (const TakenSample& s : samples)
    film.add(tileOf(film, Point2i(glm::floor(s.at))), s.at, s.L, s.alpha);
}

class EveryFilter : public testing::TestWithParam<std::string> {};

// Against the definition: the mean over all samples weighted by the filter about the pixel's
// centre.
TEST_P(EveryFilter, PixelsAreWeightedMeans) {
  const auto filter = test::make<Filter>(GetParam());
  Film film({70, 45}, {{3, 2}, {67, 41}}, *filter, {});
  const auto samples = randomSamples(film, 40000);
  addAll(film, samples);
  const Image image = film.image();
  for (const Point2i pixel : {Point2i(3, 2), Point2i(31, 33), Point2i(32, 32), Point2i(66, 40),
                              Point2i(35, 31), Point2i(40, 20)}) {
    double sum = 0, weights = 0, absolute = 0;
    for (const TakenSample& s : samples) {
      const Vec2 d = s.at - (Point2(pixel) + 0.5F);
      if (std::abs(d.x) > filter->radius().x || std::abs(d.y) > filter->radius().y) continue;
      const double w = filter->evaluate(d);
      sum += w * s.L.y;
      weights += w;
      absolute += std::abs(w);
    }
    const int index = (pixel.y - 2) * 64 + pixel.x - 3;
    // The film rounds positions to 1/32 of the filter's radius.
    EXPECT_NEAR(image.channels[1][index], sum / weights, 0.03 * absolute / std::abs(weights))
        << pixel.x << ' ' << pixel.y;
  }
}

TEST_P(EveryFilter, AConstantStaysConstant) {
  const auto filter = test::make<Filter>(GetParam());
  Film film({50, 40}, {{0, 0}, {50, 40}}, *filter, {});
  auto samples = randomSamples(film, 80000);
  for (TakenSample& s : samples) s.L = Spectrum(0.25F, 1, 3), s.alpha = 1;
  addAll(film, samples);
  const Image image = film.image();
  for (std::size_t i = 0; i < image.channels[0].size(); ++i) {
    EXPECT_NEAR(image.channels[0][i], 0.25F, 1e-5F);
    EXPECT_NEAR(image.channels[2][i], 3, 1e-5F);
    EXPECT_NEAR(image.channels[3][i], 1, 1e-5F);
  }
}

TEST_P(EveryFilter, TheOrderOfTilesDoesNotMatter) {
  const auto filter = test::make<Filter>(GetParam());
  Film forward({90, 70}, {{0, 0}, {90, 70}}, *filter, {}),
      backward({90, 70}, {{0, 0}, {90, 70}}, *filter, {});
  const auto samples = randomSamples(forward, 20000);
  for (int pass = 0; pass < forward.tiles(); ++pass)
    for (const TakenSample& s : samples) {
      const int tile = tileOf(forward, Point2i(glm::floor(s.at)));
      if (tile == pass) forward.add(tile, s.at, s.L, s.alpha);
      if (tile == forward.tiles() - 1 - pass) backward.add(tile, s.at, s.L, s.alpha);
    }
  EXPECT_EQ(forward.image().channels, backward.image().channels);
}

INSTANTIATE_TEST_SUITE_P(Names, EveryFilter,
                         testing::Values("box", "triangle", "gaussian", "mitchell", "sinc"));

TEST(Film, ABoxSampleCountsInOnePixelOnly) {
  const auto box = test::make<Filter>("box");
  for (const Point2 at : {Point2(1, 1), Point2(1.5F, 1.5F), Point2(1.9999F, 1.0001F)}) {
    Film film({4, 4}, {{0, 0}, {4, 4}}, *box, {});
    film.add(0, at, Spectrum(1), 1);
    const Image image = film.image();
    for (int i = 0; i < 16; ++i) EXPECT_EQ(image.channels[0][i], i == 5 ? 1.F : 0.F) << i;
  }
}

TEST(Film, SumsStayExactForMillionsOfSamples) {
  const auto box = test::make<Filter>("box");
  Film film({1, 1}, {{0, 0}, {1, 1}}, *box, {});
  for (int i = 0; i < 20'000'000; ++i) film.add(0, {0.5F, 0.5F}, Spectrum(i % 2 ? 0.1F : 0.3F), 1);
  EXPECT_NEAR(film.image().channels[0][0], 0.2F, 1e-7F);
}

TEST(Film, BrightSamplesAreDarkenedBeforeScaling) {
  const auto box = test::make<Filter>("box");
  Film film({1, 1}, {{0, 0}, {1, 1}}, *box, {.scale = 2, .brightest = 10});
  film.add(0, {0.5F, 0.5F}, Spectrum(1000), 1);
  EXPECT_NEAR(film.image().channels[0][0], 20, 1e-4F);
}

TEST(Film, AFilterMayNotBeWiderThanMemory) {
  const auto wide = test::make<Filter>("box", {test::number("xwidth", 1e9F)});
  EXPECT_THROW(Film({4, 4}, {{0, 0}, {4, 4}}, *wide, {}), Error);
}

TEST(Film, TooLargeAFilmIsAClearError) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer ends a program that asks for so much";
#endif
  const auto box = test::make<Filter>("box");
  EXPECT_THROW(Film({1 << 16, 1 << 16}, {{0, 0}, {1 << 16, 1 << 16}}, *box, {}), Error);
}

}  // namespace
}  // namespace pbrt
