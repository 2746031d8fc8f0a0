// The z-test lets other seeds pass and catches what noise does not explain.

#include "tools/compare/ztest.h"

#include <gtest/gtest.h>

#include <functional>

#include "core/base/error.h"
#include "core/base/rng.h"

namespace pbrt {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// One channel of equal pixels.
Image flat(int width, int height, float value, float variance, int samples) {
  Image image{.window = {{0, 0}, {width, height}},
              .resolution = {width, height},
              .names = {"R", "Variance.R"}};
  const auto pixels = static_cast<std::size_t>(width * height);
  image.channels = {std::vector<float>(pixels, value), std::vector<float>(pixels, variance)};
  image.attributes["samplesPerPixel"] = samples;
  return image;
}

Image exact(int width, int height, float value) {
  Image image = flat(width, height, value, 0, 1);
  image.names.pop_back();
  image.channels.pop_back();
  return image;
}

// Normally distributed (Box and Muller 1958).
double normal(Rng& rng) {
  return std::sqrt(-2 * std::log(1 - double{rng.uniform()})) *
         std::cos(2 * std::numbers::pi * rng.uniform());
}

// What a renderer makes of samples of this distribution, and says about its noise.
using Distribution = std::function<double(Rng&)>;
Image render(int size, int samples, std::uint64_t seed, const Distribution& draw) {
  Image image = flat(size, size, 0, 0, samples);
  Rng rng(seed);
  for (int i = 0; i < size * size; ++i) {
    double sum = 0, squares = 0;
    for (int k = 0; k < samples; ++k) {
      const double x = draw(rng);
      sum += x;
      squares += x * x;
    }
    image.channels[0][i] = static_cast<float>(sum / samples);
    image.channels[1][i] =
        static_cast<float>(std::max(0.0, squares - sum * sum / samples) / (samples - 1) / samples);
  }
  return image;
}

double halfNoise(Rng& rng) {
  return 1 + 0.5 * normal(rng);
}

double wholeZ(const Image& reference, const Image& test) {
  return zTest(reference, test)->scales[3].worst.z;
}

// The formulas of the two estimates, with numbers.
TEST(ZTest, OfFlatPicturesByHand) {
  // Equal samples: the variances add up, 0.01 + 0.04 a pixel; the pooled one is 0.0487.
  EXPECT_NEAR(wholeZ(flat(8, 8, 1, 0.01F, 16), flat(8, 8, 1.1F, 0.04F, 16)),
              0.1 / std::sqrt(0.05 / 64), 1e-5);
  // The test saw no variance, but the reference, of 1024 samples, did: s^2 = 1.024.
  const double inverse = 1 / 1024.0 + 1 / 16.0;
  const double pooled = (1023 * 1.024 + 0.01 / inverse) / (1024 + 16 - 1) * inverse;
  EXPECT_NEAR(wholeZ(flat(8, 8, 1, 0.001F, 1024), flat(8, 8, 1.1F, 0, 16)),
              0.1 / std::sqrt(pooled / 64), 1e-5);
  // An exact reference; the test's variance about it is (15 * 16 * 0.04 + 16 * 0.01) / 16 / 16.
  EXPECT_NEAR(wholeZ(exact(8, 8, 1), flat(8, 8, 0.9F, 0.04F, 16)), -0.1 / std::sqrt(0.04 / 64),
              1e-5);
  EXPECT_NEAR(wholeZ(exact(8, 8, 1), flat(8, 8, 0, 0, 16)), -std::sqrt(16 * 64.0), 1e-4);
}

TEST(ZTest, KnowsThatWideFiltersCorrelatePixels) {
  Image reference = flat(8, 8, 1, 0.01F, 1 << 20), test = flat(8, 8, 1.1F, 0.01F, 1 << 20);
  reference.attributes["filterNoise"] = test.attributes["filterNoise"] = 0.25F;
  const ZTest z = *zTest(reference, test);
  EXPECT_NEAR(z.scales[0].worst.z, 0.1 / std::sqrt(0.02), 1e-4) << "a pixel is what it says";
  EXPECT_NEAR(z.scales[3].worst.z, 0.1 / std::sqrt(0.02 / 0.25 / 64), 1e-4);
}

TEST(ZTest, OfPicturesWithoutNoiseIsExact) {
  const Image reference = flat(64, 64, 0.3F, 0, 64);
  EXPECT_TRUE(zTest(reference, reference)->agree());
  EXPECT_EQ(zTest(reference, reference)->scales[3].worst.z, 0);
  Image rounded = reference;
  for (float& v : rounded.channels[0]) v *= 1.00002F;
  EXPECT_TRUE(zTest(reference, rounded)->agree()) << "another machine";
  Image brighter = reference;
  for (float& v : brighter.channels[0]) v *= 1.0001F;
  EXPECT_FALSE(zTest(reference, brighter)->agree());
  Image moved = reference;  // no block's mean changes
  moved.channels[0][100] += 0.1F;
  moved.channels[0][101] -= 0.1F;
  const ZTest z = *zTest(reference, moved);
  ASSERT_EQ(z.scales[0].failures.size(), 2U);
  EXPECT_EQ(z.scales[0].failures[0].corner.y, 1);
  EXPECT_FALSE(z.agree());
}

// Holm: of two blocks, one beyond alpha / 4 / 2 lets the other fail beyond alpha / 4. For alpha =
// 0.004 that is |z| = 3.4808 and 3.2905.
TEST(ZTest, HoldsTheSecondWorstBlockToLess) {
  const auto failures = [](double first, double second) {
    Image reference = flat(16, 8, 1, 0.005F, 1 << 20), test = reference;
    for (int i = 0; i < 128; ++i)
      test.channels[0][i] += static_cast<float>((i % 16 < 8 ? first : second) * 0.1 / 8);
    return zTest(reference, test, 0.004)->scales[1].failures.size();
  };
  EXPECT_EQ(failures(0, 3.4), 0U);
  EXPECT_EQ(failures(3.55, 0), 1U);
  EXPECT_EQ(failures(3.55, 3.25), 1U);
  EXPECT_EQ(failures(3.55, 3.4), 2U);
  EXPECT_EQ(failures(-3.4, 3.55), 2U);
}

TEST(ZTest, IsNormalForOtherSeeds) {
  constexpr int kTrials = 300;
  double sum = 0, squares = 0, beyond = 0;
  for (int i = 0; i < kTrials; ++i) {
    const ZTest z = *zTest(render(64, 4, 2 * i, halfNoise), render(64, 4, 2 * i + 1, halfNoise));
    sum += z.scales[3].worst.z;
    squares += sqr(z.scales[3].worst.z);
    beyond += z.scales[1].beyond3 * 64;
  }
  EXPECT_NEAR(sum / kTrials, 0, 4 / std::sqrt(kTrials));
  EXPECT_NEAR(squares / kTrials, 1, 4 * std::sqrt(2.0 / kTrials));
  const double expected = 0.0027 * 64 * kTrials;
  EXPECT_NEAR(beyond, expected, 5 * std::sqrt(expected));
}

// Alarms over trials with alpha = 0.05 are binomial with p <= 0.05; of 200, more than 27 have a
// chance below 1e-5. Beside normal noise: skewed, and rare bright samples that the picture of fewer
// samples misses or, by chance, has too many of.
TEST(ZTest, AlarmsNoMoreOftenThanAlpha) {
  const std::pair<const char*, Distribution> distributions[] = {
      {"normal", halfNoise},
      {"log-normal", [](Rng& rng) { return std::exp(normal(rng)); }},
      {"very skewed", [](Rng& rng) { return std::exp(2 * normal(rng)); }},
      {"fireflies", [](Rng& rng) { return rng.uniform() < 1e-3F ? 300.0 : double{rng.uniform()}; }},
      {"an edge", [](Rng& rng) { return rng.uniform() < 0.03F ? 1.0 : 0.0; }}};
  for (const auto& [name, draw] : distributions)
    for (const auto& [many, few] : {std::pair{16, 16}, {128, 16}, {32, 2}, {2, 2}}) {
      int alarms = 0;
      for (int i = 0; i < 200; ++i) {
        const std::uint64_t seed = hash(i, many, few);
        alarms +=
            !zTest(render(16, many, seed, draw), render(16, few, seed + 1, draw), 0.05)->agree();
      }
      EXPECT_LE(alarms, 27) << name << ", " << many << " against " << few << " samples";
    }
}

TEST(ZTest, CatchesOnePerCent) {
  for (const double bias : {0.99, 1.01})
    for (int i = 0; i < 10; ++i) {
      const auto biased = [&](Rng& rng) { return bias * halfNoise(rng); };
      const ZTest z = *zTest(render(64, 64, 2 * i, halfNoise), render(64, 64, 2 * i + 1, biased));
      EXPECT_FALSE(z.agree());
      EXPECT_EQ(z.scales[3].worst.z > 0, bias > 1);
      EXPECT_FALSE(z.scales[3].failures.empty()) << "the whole picture tells best";
    }
}

TEST(ZTest, TellsWhichBlock) {
  Image reference = render(64, 16, 1, halfNoise), test = render(64, 16, 2, halfNoise);
  reference.window = test.window = {{100, 200}, {164, 264}};
  for (int y = 16; y < 24; ++y)
    for (int x = 40; x < 48; ++x) test.channels[0][y * 64 + x] += 0.25F;  // two sigma each
  const ZTest z = *zTest(reference, test);
  ASSERT_EQ(z.scales[1].failures.size(), 1U);
  EXPECT_EQ(z.scales[1].failures[0].corner, Point2i(140, 216));
  EXPECT_EQ(z.channels[z.scales[1].failures[0].channel], "R");
  EXPECT_TRUE(z.scales[0].failures.empty());
}

TEST(ZTest, CatchesADeadPixelFrom16Samples) {
  for (const int samples : {8, 16, 64}) {
    const auto noise = [](Rng& rng) { return 1 + 0.1 * normal(rng); };
    Image test = render(64, samples, 2, noise);
    test.channels[0][2000] = test.channels[1][2000] = 0;
    const ZTest z = *zTest(render(64, samples, 1, noise), test);
    EXPECT_EQ(z.scales[0].n, samples < 16 ? 0U : 4096U);
    EXPECT_EQ(z.scales[0].failures.size(), samples < 16 ? 0U : 1U);
  }
}

TEST(ZTest, FailsForWhatIsNoNumberOrNoVariance) {
  const Image good = flat(40, 40, 1, 0.1F, 16);
  for (const auto& [channel, bad] : {std::pair{0, kNan},
                                     {0, kInfinity},
                                     {0, -kInfinity},
                                     {1, kNan},
                                     {1, kInfinity},
                                     {1, -1e-9F}})
    for (const int samples : {2, 16}) {
      Image broken = flat(40, 40, 1, 0.1F, samples);
      broken.channels[channel][777] = bad;
      EXPECT_FALSE(zTest(good, broken)->agree()) << channel << ' ' << bad;
      EXPECT_FALSE(zTest(broken, good)->agree()) << channel << ' ' << bad;
      EXPECT_FALSE(zTest(broken, broken)->agree()) << channel << ' ' << bad;
    }
  for (const float kappa : {0.F, -1.F, kNan, kInfinity}) {
    Image broken = good;
    broken.attributes["filterNoise"] = kappa;
    EXPECT_FALSE(zTest(good, broken)->agree()) << kappa;
  }
}

TEST(ZTest, TellsWhatIsTakenAsExact) {
  const Image noisy = flat(8, 8, 1, 0.1F, 16), one = flat(8, 8, 1, 0, 1);
  const Image known = exact(8, 8, 1);
  EXPECT_FALSE(zTest(noisy, noisy)->referenceIsExact || zTest(noisy, noisy)->testIsExact);
  for (const Image& sure : {known, one}) {
    EXPECT_TRUE(zTest(sure, noisy)->referenceIsExact);
    EXPECT_FALSE(zTest(sure, noisy)->testIsExact);
    EXPECT_TRUE(zTest(noisy, sure)->testIsExact);
    EXPECT_TRUE(zTest(sure, noisy)->agree());
    EXPECT_FALSE(zTest(sure, sure).has_value()) << "one sample has no variance";
  }
}

TEST(ZTest, NeedsTheSamePixelsAndAProbability) {
  const Image image = flat(4, 4, 1, 0.1F, 16);
  EXPECT_THROW(zTest(image, flat(8, 2, 1, 0.1F, 16)), Error);
  EXPECT_THROW(zTest(Image(), Image()), Error);
  for (const double alpha : {0.0, 1.0, -1.0, double{kNan}})
    EXPECT_THROW(zTest(image, image, alpha), Error);
}

}  // namespace
}  // namespace pbrt
