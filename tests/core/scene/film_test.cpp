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
  bool opaque;
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
                       rng.uniform() < 0.7F});
  return samples;
}

void addAll(Film& film, const std::vector<TakenSample>& samples) {
  for (const TakenSample& s : samples)
    film.add(tileOf(film, Point2i(glm::floor(s.at))), s.at, s.L, s.opaque);
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
  for (TakenSample& s : samples) s.L = Spectrum(0.25F, 1, 3), s.opaque = true;
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
      if (tile == pass) forward.add(tile, s.at, s.L, s.opaque);
      if (tile == forward.tiles() - 1 - pass) backward.add(tile, s.at, s.L, s.opaque);
    }
  EXPECT_EQ(forward.image().channels, backward.image().channels);
}

// Samples from 1e-30 to 1e30 beside one another, dealt out to some films at random, in another
// order, which are put together in any order: the same bits, of all that is stored.
TEST_P(EveryFilter, FilmsArePutTogetherInAnyOrder) {
  const auto filter = test::make<Filter>(GetParam());
  const Bounds2i crop{{5, 4}, {66, 41}};
  const auto empty = [&] { return Film({70, 45}, crop, *filter, {.aovs = kEveryAov}); };
  Film whole = empty();
  std::vector<Film> parts(7, empty());
  Rng rng(3);
  const auto any = [&] {
    return std::pow(10.F, 60 * rng.uniform() - 30) * (rng.uniform() < 0.1F ? 0 : 1);
  };
  auto samples = randomSamples(whole, 30000);
  for (TakenSample& s : samples) s.L = {any(), any(), any()};
  const auto addTo = [&](Film& film, std::size_t i) {
    const TakenSample& s = samples[i];
    const Point2i pixel(glm::floor(s.at));
    const int tile = tileOf(film, pixel);
    film.add(tile, s.at, s.L, s.opaque);
    FirstSurface surface;
    surface.albedo = surface.p = surface.n = s.L;
    surface.depth = s.L.x;
    surface.uv = {s.L.y, s.L.z};
    surface.shape = static_cast<std::uint32_t>(1 + i % 1000);
    film.add(tile, pixel, static_cast<std::uint32_t>(i), surface);
  };
  for (std::size_t i = 0; i < samples.size(); ++i) addTo(whole, i);
  for (std::size_t i = samples.size(); i-- > 0;)
    addTo(parts[static_cast<std::size_t>(7 * rng.uniform())], i);
  const Image expected = whole.image();
  for (int order = 0; order < 3; ++order) {
    std::vector<std::size_t> left = {0, 1, 2, 3, 4, 5, 6};
    Film merged = empty();
    while (!left.empty()) {
      const auto next = static_cast<std::ptrdiff_t>(rng.uniform() * float(left.size()));
      const Film& part = parts[left[next]];
      left.erase(left.begin() + next);
      for (int y = crop.lo.y; y < crop.hi.y; ++y)
        for (int x = crop.lo.x; x < crop.hi.x; ++x) merged.add({x, y}, part.pixel({x, y}));
    }
    EXPECT_EQ(merged.image().channels, expected.channels);
  }
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

// Infinities would make all that follows no number.
TEST(Film, WhatOverflowsCountsAsTheLargestNumber) {
  const auto box = test::make<Filter>("box");
  Film film({1, 1}, {{0, 0}, {1, 1}}, *box, {.scale = 1e30F, .aovs = kEveryAov});
  FirstSurface far;
  far.depth = kInfinity;
  far.p = Point3(-kInfinity, std::nanf(""), 3);
  for (int i = 0; i < 2; ++i) {
    film.add(0, {0.5F, 0.5F}, Spectrum(1e30F, 1, 0), 1);
    film.add(0, {0, 0}, 0, far);
  }
  const Image image = film.image();
  constexpr float kMost = std::numeric_limits<float>::max();
  EXPECT_EQ(image.channels[0][0], kMost);
  EXPECT_EQ(image.channels[1][0], 1e30F);
  EXPECT_EQ(image.channel("Z")->at(0), kMost);
  EXPECT_EQ(image.channel("P.X")->at(0), -kMost);
  EXPECT_EQ(image.channel("P.Y")->at(0), 0);
  EXPECT_EQ(image.channel("P.Z")->at(0), 3);
}

// Far from the picture's corner a float has few bits for the place in the pixel: the same whichever
// tile and crop the sample is in.
TEST(Film, WeightsDoNotDependOnTheTile) {
  const auto gaussian = test::make<Filter>("gaussian");
  const Point2i size(40000, 40000);
  const Bounds2i crop{{39990, 39990}, {39992, 39992}}, other{{39960, 39985}, {39999, 39998}};
  Film small(size, crop, *gaussian, {}), large(size, other, *gaussian, {});
  for (const TakenSample& s : randomSamples(small, 2000))
    for (Film* film : {&small, &large})
      film->add(tileOf(*film, Point2i(glm::floor(s.at))), s.at, s.L, s.opaque);
  for (int c = 0; c < 4; ++c)
    for (int i = 0; i < 4; ++i)
      EXPECT_EQ(small.image().channels[c][i],
                large.image().channels[c][(5 + i / 2) * 39 + 30 + i % 2]);
}

TEST(Film, AFilterMayNotBeWiderThanMemory) {
  const auto wide = test::make<Filter>("box", {test::number("xwidth", 1e9F)});
  EXPECT_THROW(Film({4, 4}, {{0, 0}, {4, 4}}, *wide, {}), Error);
}

TEST(Film, WhatGivesNoWeightsIsNoFilter) {
  struct Level final : Filter {
    explicit Level(float w) : Filter(Vec2(1)), weight(w) {}
    float evaluate(Vec2 p) const override { return p.x > 0.5F ? weight : 0; }
    float weight;
  };
  for (const float w : {std::nanf(""), kInfinity, -kInfinity, 0.F}) try {
      Film({4, 4}, {{0, 0}, {4, 4}}, Level(w), {});
      ADD_FAILURE() << w;
    } catch (const Error& error) {
      EXPECT_EQ(error.failure(), Failure::plugin);
    }
  Film({4, 4}, {{0, 0}, {4, 4}}, Level(-1), {});
}

TEST(Film, BlocksFillTiles) {
  const auto box = test::make<Filter>("box");
  for (const int block : {-4, 0, 3, 12, 64})
    EXPECT_THROW(Film({4, 4}, {{0, 0}, {4, 4}}, *box, {.block = block}), Error) << block;
  for (const int block : {1, 2, 32}) Film({4, 4}, {{0, 0}, {4, 4}}, *box, {.block = block});
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
