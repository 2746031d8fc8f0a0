#include "core/base/distribution.h"

#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "tests/chi_square.h"

namespace pbrt {
namespace {

TEST(Distribution2D, ChoosesByTheWeights) {
  const std::vector<double> weights = {1, 0, 5, 0.5, 0, 0, 0, 0, 2, 2, 0, 3};
  const Distribution2D cells(4, weights);
  EXPECT_EQ(cells.total(), 13.5);
  Rng rng(1);
  constexpr int n = 200000;
  std::vector<double> counts(weights.size()), quarters(4);
  for (int i = 0; i < n; ++i) {
    const auto cell = cells.sample({rng.uniform(), rng.uniform()});
    const int k = cell.y * 4 + cell.x;
    ASSERT_GT(weights.at(k), 0);
    ASSERT_NEAR(cell.chance, weights[k] / 13.5, 1e-12);
    ASSERT_EQ(cell.chance, cells.chance(cell.x, cell.y));
    ++counts[k];
    ASSERT_TRUE(cell.within.x >= 0 && cell.within.x < 1 && cell.within.y >= 0 && cell.within.y < 1);
    ++quarters[(cell.within.x < 0.5F) + 2 * (cell.within.y < 0.5F)];
  }
  std::vector<double> seen, expected;
  for (std::size_t i = 0; i < weights.size(); ++i)
    if (weights[i] > 0) {
      seen.push_back(counts[i]);
      expected.push_back(n * weights[i] / 13.5);
    }
  EXPECT_LT(test::chiSquareDeviation(seen, expected), 4);
  EXPECT_LT(test::uniformDeviation(quarters), 4);
}

// The ends of the unit square, where sums round.
TEST(Distribution2D, NeverChoosesWhatHasNoWeight) {
  Rng rng(2);
  for (int i = 0; i < 2000; ++i) {
    std::vector<double> weights(30);
    for (double& w : weights) w = rng.uniform() < 0.7F ? 0 : std::exp(40 * rng.uniform() - 20);
    weights[7] = 1e-300;
    const Distribution2D cells(6, weights);
    for (const float u : {0.F, 1e-30F, 0.5F, kOneMinusEpsilon})
      for (const float v : {0.F, 1e-30F, 0.5F, kOneMinusEpsilon}) {
        const auto cell = cells.sample({u, v});
        ASSERT_GT(weights[cell.y * 6 + cell.x], 0);
      }
  }
}

TEST(Distribution2D, NothingToChooseFrom) {
  const Distribution2D cells(2, {0, 0, 0, 0});
  EXPECT_EQ(cells.sample({0.5F, 0.5F}).chance, 0);
  EXPECT_EQ(cells.chance(1, 1), 0);
}

}  // namespace
}  // namespace pbrt
