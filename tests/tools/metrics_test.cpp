// The measures of error against what they are defined to be, worked out by hand or the long way.

#include "tools/compare/metrics.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/rng.h"

namespace pbrt {
namespace {

Image picture(int width, int height, const std::vector<float>& rgb) {
  Image image{
      .window = {{0, 0}, {width, height}}, .resolution = {width, height}, .names = {"R", "G", "B"}};
  for (std::size_t c = 0; c < 3; ++c) {
    std::vector<float>& channel = image.channels.emplace_back();
    for (std::size_t i = c; i < rgb.size(); i += 3) channel.push_back(rgb[i]);
  }
  return image;
}

TEST(Metrics, OfTwoPixelsByHand) {
  const Image reference = picture(2, 1, {1, 0, 2, 0.5F, 0, 0});
  const Image test = picture(2, 1, {1.5F, 0, 1, 0.5F, 0.25F, 0});
  const Errors e = measureErrors(reference, test);
  // Differences: 0.5, 0, -1, 0, 0.25, 0.
  EXPECT_DOUBLE_EQ(e.mse, (0.25 + 1 + 0.0625) / 6);
  EXPECT_DOUBLE_EQ(e.rmse, std::sqrt((0.25 + 1 + 0.0625) / 6));
  EXPECT_DOUBLE_EQ(e.mae, 1.75 / 6);
  EXPECT_DOUBLE_EQ(e.relMse, (0.25 / 1.01 + 1 / 4.01 + 0.0625 / 0.01) / 6);
  EXPECT_DOUBLE_EQ(e.meanReference, 3.5 / 6);
  EXPECT_DOUBLE_EQ(e.meanTest, 3.25 / 6);
  EXPECT_EQ(e.largest, 1);
  EXPECT_EQ(e.largestPixel, Point2i(0, 0));
}

TEST(Metrics, OfEqualPicturesAreZero) {
  const Image image = picture(2, 2, {1, 2, 3, 4, 5, 6, 7, 8, 9, 1e30F, 0, -1});
  const Errors e = measureErrors(image, image);
  EXPECT_EQ(e.mse, 0);
  EXPECT_EQ(e.relMse, 0);
  EXPECT_EQ(e.mae, 0);
  EXPECT_EQ(e.largest, 0);
}

// Of N values, floor(N / 1000) are dropped: none of 999, one of 1002.
TEST(Metrics, RelativeErrorDropsOneInAThousand) {
  for (const int pixels : {333, 334}) {
    const std::vector<float> black(std::size_t(pixels) * 3);
    std::vector<float> values = black;
    values[100] = 1000;  // a firefly
    values[200] = 1;
    const Errors e = measureErrors(picture(pixels, 1, black), picture(pixels, 1, values));
    const double n = pixels * 3, kept = pixels == 333 ? 999 : 1001;
    EXPECT_DOUBLE_EQ(e.relMse, (pixels == 333 ? (1e6 + 1) / 0.01 : 1 / 0.01) / kept);
    EXPECT_DOUBLE_EQ(e.mse, (1e6 + 1) / n) << "nothing else drops it";
  }
}

TEST(Metrics, AgreeWithLongSumsOverRandomPictures) {
  constexpr int kWidth = 71, kHeight = 53, kValues = kWidth * kHeight * 3;
  Rng rng(7);
  std::vector<float> a, b;
  for (int i = 0; i < kValues; ++i) {
    a.push_back(std::exp(10 * rng.uniform() - 5));
    b.push_back(a.back() + rng.uniform() - 0.5F);
  }
  long double squares = 0, magnitudes = 0, relative = 0;
  std::vector<long double> terms;
  for (int i = 0; i < kValues; ++i) {
    const long double d = static_cast<long double>(b[i]) - a[i];
    squares += d * d;
    magnitudes += std::abs(d);
    terms.push_back(d * d / (static_cast<long double>(a[i]) * a[i] + 0.01L));
  }
  std::sort(terms.begin(), terms.end());
  for (int i = 0; i < kValues - kValues / 1000; ++i) relative += terms[i];
  const Errors e = measureErrors(picture(kWidth, kHeight, a), picture(kWidth, kHeight, b));
  EXPECT_NEAR(e.mse, static_cast<double>(squares / kValues), 1e-12);
  EXPECT_NEAR(e.mae, static_cast<double>(magnitudes / kValues), 1e-12);
  EXPECT_NEAR(e.relMse, static_cast<double>(relative / (kValues - kValues / 1000)), 1e-12);
}

TEST(Metrics, TellWhereTheLargestErrorIs) {
  Image reference = picture(3, 2, std::vector<float>(18));
  reference.window = {{10, 20}, {13, 22}};
  Image test = reference;
  test.channels[1][5] = -2;  // the last pixel
  test.channels[2][4] = 1;
  const Errors e = measureErrors(reference, test);
  EXPECT_EQ(e.largest, 2);
  EXPECT_EQ(e.largestPixel, Point2i(12, 21));
}

TEST(Metrics, OfWhatIsNotANumberAreNotNumbers) {
  for (int c = 0; c < 3; ++c)
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), kInfinity, -kInfinity}) {
      const Image reference = picture(400, 1, std::vector<float>(1200, 1));
      Image test = reference;
      test.channels[c][17] = bad;
      test.channels[0][30] = 5;
      for (const Errors& e : {measureErrors(reference, test), measureErrors(test, reference)}) {
        EXPECT_FALSE(std::isfinite(e.mse));
        EXPECT_FALSE(std::isfinite(e.rmse));
        EXPECT_FALSE(std::isfinite(e.relMse)) << "dropping the largest must not hide it";
        EXPECT_FALSE(std::isfinite(e.mae));
        EXPECT_FALSE(std::isfinite(e.largest));
        EXPECT_EQ(e.largestPixel, Point2i(17, 0));
      }
    }
}

TEST(Metrics, NeedTheSamePixelsAndColours) {
  const Image image = picture(2, 1, {0, 0, 0, 0, 0, 0});
  EXPECT_THROW(measureErrors(image, picture(1, 2, {0, 0, 0, 0, 0, 0})), Error);
  EXPECT_THROW(measureErrors(Image(), Image()), Error);
  Image grey = image;
  grey.names = {"Y", "G", "B"};
  EXPECT_THROW(measureErrors(image, grey), Error);
  EXPECT_THROW(measureErrors(grey, image), Error);
}

}  // namespace
}  // namespace pbrt
