#include "tools/compare/flip.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "tests/tools/flip_pictures.h"

namespace pbrt {
namespace {

using namespace test;

TEST(Flip, OfAPictureAndItselfIsZero) {
  const Image a = noisy(20, 11, 1);
  for (const FlipMap& map : {flip(a, a), flipHdr(a, a)}) {
    EXPECT_EQ(map.mean, 0);
    EXPECT_EQ(map.values, std::vector<float>(a.channels[0].size(), 0.F));
  }
}

TEST(Flip, IsSymmetricOnScreen) {
  const Image a = noisy(20, 11, 1), b = noisy(20, 11, 2);
  EXPECT_EQ(flip(a, b).values, flip(b, a).values);
}

TEST(Flip, StaysWithinZeroAndOneInAllOfTheGamut) {
  for (int seed = 0; seed < 20; ++seed) {
    const auto corner = [=](int x, int y, int c, int s) {
      return noise(x / 3, y / 3, c, 2 * seed + s) < 0.5F ? 0.F : 1.F;
    };
    const Image a = picture(24, 15, [&](int x, int y, int c) { return corner(x, y, c, 0); });
    const Image b = picture(24, 15, [&](int x, int y, int c) { return corner(x, y, c, 1); });
    for (const double pixelsPerDegree : {1., 67., 1000.})
      for (const FlipMap& map : {flip(a, b, pixelsPerDegree), flipHdr(a, b, pixelsPerDegree)})
        for (const float v : map.values) {
          ASSERT_GE(v, 0);
          ASSERT_LE(v, 1);
        }
  }
}

TEST(Flip, TurnsWithThePictures) {
  const Image a = noisy(12, 12, 1), b = noisy(12, 12, 2);
  const auto turned = [](const Image& from) {
    return picture(12, 12, [&](int x, int y, int c) { return from.channels[c][x * 12 + 11 - y]; });
  };
  const FlipMap map = flip(a, b), turnedMap = flip(turned(a), turned(b));
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 12; ++x)
      EXPECT_NEAR(turnedMap.values[y * 12 + x], map.values[x * 12 + 11 - y], 1e-6);
}

TEST(Flip, AShiftedLineMattersLessFromFartherOff) {
  const auto line = [](int at) {
    return picture(64, 32, [=](int x, int, int) { return x == at ? 0.9F : 0.1F; });
  };
  double last = 1;
  for (const double pixelsPerDegree : {15., 30., 60., 120., 240.}) {
    const FlipMap map = flip(line(31), line(33), pixelsPerDegree);
    const double largest = *std::max_element(map.values.begin(), map.values.end());
    EXPECT_LT(largest, last) << pixelsPerDegree;
    last = largest;
  }
}

TEST(Flip, OfHighRangesDoesNotDependOnTheUnitOfLight) {
  const FlipMap map = flipHdr(noisy(20, 11, 1), noisy(20, 11, 2));
  for (const float scale : {0x1p-30F, 0x1p40F}) {
    const FlipMap scaled = flipHdr(noisy(20, 11, 1, scale), noisy(20, 11, 2, scale));
    for (std::size_t i = 0; i < map.values.size(); ++i)
      EXPECT_NEAR(scaled.values[i], map.values[i], 1e-6);
  }
}

// What a screen without the exposures of HDR-FLIP cannot show.
TEST(Flip, OfHighRangesSeesDifferencesInLightsAndInTheDark) {
  const auto lamps = [](float wall, float lamp) {
    return picture(32, 16, [=](int x, int, int) { return x < 20 ? wall : lamp; });
  };
  constexpr float dark = 0x1p-16F, lit = 128;
  const Image reference = lamps(dark, lit);
  EXPECT_EQ(flip(reference, lamps(dark, 2 * lit)).mean, 0);
  EXPECT_GT(flipHdr(reference, lamps(dark, 2 * lit)).values[30], 0.1);
  EXPECT_LT(flip(reference, lamps(2 * dark, lit)).values[0], 0.01);
  EXPECT_GT(flipHdr(reference, lamps(2 * dark, lit)).values[0], 0.1);
}

TEST(Flip, HasAnExposureForBlackReferencesAndForTheLargestNumbers) {
  const float huge = std::numeric_limits<float>::max(), tiny = std::numeric_limits<float>::min();
  const Image black = constant(6, 5, 0, 0, 0), white = constant(6, 5, 1, 1, 1);
  // Exposure 0: (0.36 x 2.51 + 0.6 x 0.03) / (0.36 x 2.43 + 0.6 x 0.59 + 0.14) of grey.
  const float grey = 0.9216F / 1.3688F;
  EXPECT_NEAR(flipHdr(black, white).mean, flip(black, constant(6, 5, grey, grey, grey)).mean, 1e-6);
  EXPECT_EQ(flipHdr(black, black).mean, 0);
  // Mostly black: as bright as what is lit.
  const auto lit = [](float value) {
    return picture(6, 5, [=](int x, int y, int) { return x == 2 && y == 2 ? value : 0; });
  };
  EXPECT_GT(flipHdr(lit(1e-6F), lit(2e-6F)).mean, 0.01);
  for (const Image& a : {constant(6, 5, huge, huge, huge), lit(huge), lit(tiny), noisy(6, 5, 1)})
    for (const Image& b : {constant(6, 5, huge, huge, huge), lit(tiny), black})
      for (const FlipMap& map : {flip(a, b), flipHdr(a, b), flipHdr(b, a)}) {
        EXPECT_GE(map.mean, 0);
        EXPECT_LE(map.mean, 1);
      }
}

TEST(Flip, CountsPixelsThatAreNotFiniteAsOneAndSparesTheirNeighbours) {
  const Image a = noisy(30, 20, 1), b = noisy(30, 20, 2);
  constexpr int kBad = 7 * 30 + 11;
  const auto with = [](Image image, std::initializer_list<int> channels, float value) {
    for (const int c : channels) image.channels[c][kBad] = value;
    return image;
  };
  const Image darkA = with(a, {0, 1, 2}, 0), darkB = with(b, {0, 1, 2}, 0);
  for (const float value : {std::numeric_limits<float>::quiet_NaN(), kInfinity, -kInfinity})
    for (const int c : {0, 1, 2})
      for (const bool hdr : {false, true}) {
        const auto compare = hdr ? flipHdr : flip;
        FlipMap expected = compare(darkA, darkB, kPixelsPerDegree);
        expected.values[kBad] = 1;
        EXPECT_EQ(compare(a, with(b, {c}, value), kPixelsPerDegree).values, expected.values);
        EXPECT_EQ(compare(with(a, {c}, value), b, kPixelsPerDegree).values, expected.values);
        const Image bad = with(a, {c}, value);
        EXPECT_FLOAT_EQ(static_cast<float>(compare(bad, bad, kPixelsPerDegree).mean), 1 / 600.F);
      }
}

TEST(Flip, TakesNegativeLightAsNone) {
  EXPECT_EQ(flip(constant(4, 4, -1, 0.5F, -0.F), constant(4, 4, 0, 0.5F, 0)).mean, 0);
  EXPECT_EQ(flipHdr(constant(4, 4, -1, 0.5F, -0.F), constant(4, 4, 0, 0.5F, 0)).mean, 0);
}

TEST(Flip, ComparesCroppedPicturesAndLeavesOtherChannelsAlone) {
  Image a = noisy(10, 8, 1), b = noisy(10, 8, 2);
  const FlipMap map = flip(a, b);
  for (Image* image : {&a, &b}) {
    image->window = {{5, 7}, {15, 15}};
    image->resolution = {100, 100};
    std::swap(image->names[0], image->names[2]);
    std::swap(image->channels[0], image->channels[2]);
  }
  b.names.emplace_back("A");
  b.channels.emplace_back(80, std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(flip(a, b).values, map.values);
}

TEST(Flip, IsTheSameOnOneThread) {
  const Image a = noisy(40, 30, 1), b = noisy(40, 30, 2);
  const FlipMap map = flipHdr(a, b);
  const ThreadLimit limit(1);
  EXPECT_EQ(flipHdr(a, b).values, map.values);
}

TEST(Flip, RefusesWhatCannotBeCompared) {
  const Image a = noisy(4, 3, 1);
  Image noBlue = a, moved = a;
  noBlue.names[2] = "Z";
  moved.window = {{1, 0}, {5, 3}};
  for (const auto compare : {flip, flipHdr}) {
    for (const Image& other : {noisy(3, 4, 1), noisy(5, 3, 1), noBlue, moved, Image{}}) {
      EXPECT_THROW(compare(a, other, 67), Error);
      EXPECT_THROW(compare(other, a, 67), Error);
    }
    EXPECT_THROW(compare(Image{}, Image{}, 67), Error);
    for (const double pixelsPerDegree : {0., -67., 0.99, 1001., std::nan("")})
      EXPECT_THROW(compare(a, a, pixelsPerDegree), Error);
  }
}

}  // namespace
}  // namespace pbrt
