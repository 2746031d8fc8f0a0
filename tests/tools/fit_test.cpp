// Means and lines through points, against numbers worked out by hand and by how often they hold.

#include "tools/converge/fit.h"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "core/base/rng.h"

namespace pbrt {
namespace {

using Values = std::vector<double>;

TEST(MeanOf, ByHand) {
  // Deviations -3, -1, 1, 3: their squares sum to 20; sqrt(20 / 3 / 4).
  const Estimate mean = meanOf(Values{1, 3, 5, 7});
  EXPECT_DOUBLE_EQ(mean.value, 4);
  EXPECT_NEAR(mean.error.value(), std::sqrt(5.0 / 3), 1e-15);
}

TEST(MeanOf, OneValueSaysNothingOfItsError) {
  EXPECT_EQ(meanOf(Values{2.5}).value, 2.5);
  EXPECT_FALSE(meanOf(Values{2.5}).error);
}

// x = 0 ... 3, y = 1 3 2 5: means 1.5 and 2.75; xx = 5, xy = 5.5, yy = 8.75. Slope 1.1; what is
// left is 8.75 - 6.05 = 2.7 over 2 degrees of freedom, so the error is sqrt(1.35 / 5).
TEST(SlopeOf, ByHand) {
  const auto slope = slopeOf(Values{0, 1, 2, 3}, Values{1, 3, 2, 5});
  ASSERT_TRUE(slope);
  EXPECT_NEAR(slope->value, 1.1, 1e-14);
  EXPECT_NEAR(slope->error.value(), std::sqrt(0.27), 1e-14);
}

TEST(SlopeOf, ALineHasNoError) {
  const auto slope = slopeOf(Values{-1, 0.5, 4, 100}, Values{2.5, 1.75, 0, -48});
  ASSERT_TRUE(slope);
  EXPECT_NEAR(slope->value, -0.5, 1e-14);
  EXPECT_LT(slope->error.value(), 1e-8);
}

TEST(SlopeOf, NeedsThreePointsAndTwoPlaces) {
  EXPECT_FALSE(slopeOf(Values{}, Values{}));
  EXPECT_FALSE(slopeOf(Values{1, 2}, Values{1, 2}));
  EXPECT_FALSE(slopeOf(Values{2, 2, 2}, Values{1, 2, 3}));
  EXPECT_TRUE(slopeOf(Values{2, 2, 3}, Values{1, 2, 3}));
}

// Lines with normal noise: with many points, (slope - truth) / error is all but normal.
TEST(SlopeOf, TheErrorCoversTheTruthAsOftenAsItShould) {
  constexpr int kTrials = 20000, kPoints = 200;
  Rng rng(7);
  const auto normal = [&] {
    return std::sqrt(-2 * std::log(1 - double{rng.uniform()})) *
           std::cos(2 * std::numbers::pi * rng.uniform());
  };
  std::array<int, 4> within{};
  for (int t = 0; t < kTrials; ++t) {
    Values x, y;
    for (int i = 0; i < kPoints; ++i) {
      x.push_back(5.0 * rng.uniform());
      y.push_back(2 - 0.5 * x.back() + 0.3 * normal());
    }
    const Estimate slope = slopeOf(x, y).value();
    const double z = std::abs(slope.value + 0.5) / slope.error.value();
    for (int k = 1; k <= 3; ++k) within[k] += z < k;
  }
  // Shares of Student's t with 198 degrees of freedom; four standard errors of a share.
  const std::array<double, 4> share = {0, 0.6815, 0.9531, 0.99695};
  for (int k = 1; k <= 3; ++k)
    EXPECT_NEAR(within[k], kTrials * share[k], 4 * std::sqrt(kTrials * share[k] * (1 - share[k])))
        << k;
}

}  // namespace
}  // namespace pbrt
