#include "tools/rate_estimate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

namespace pbrt {
namespace {

// A render of work 1 of which `seconds(w)` is the time that the first part w took.
struct Trace {
  std::function<double(double)> seconds;

  // Plays it up to a part of the work, looked at ten times a second as Progress does. Work shows in
  // lumps of `lump`.
  void play(RateEstimate& estimate, double upTo, double lump = 1e-4) const {
    const double end = seconds(upTo);
    for (double now = 0; now < end; now += 0.1) estimate.add(now, done(now, lump));
  }
  double done(double now, double lump) const {
    double low = 0, high = 1;
    for (int i = 0; i < 50; ++i) (seconds((low + high) / 2) <= now ? low : high) = (low + high) / 2;
    return std::floor(low / lump + 1e-9) * lump;
  }
  // The remaining time estimated at a part of the work, over the true one.
  double ratio(double at, double lump = 1e-4) const {
    RateEstimate estimate;
    play(estimate, at, lump);
    const auto remaining = estimate.remaining(1 - at);
    return remaining ? *remaining / (seconds(1) - seconds(at))
                     : std::numeric_limits<double>::quiet_NaN();
  }
};

TEST(RateEstimate, KnowsNothingBeforeWorkGoesOn) {
  RateEstimate estimate;
  EXPECT_FALSE(estimate.remaining(1));
  for (double now = 0; now < 100; now += 0.1) {
    estimate.add(now, 0);
    ASSERT_FALSE(estimate.rate());
  }
  estimate.add(100, 5);  // who knows since when
  EXPECT_FALSE(estimate.remaining(1));
  estimate.add(100, 9);  // in no time
  EXPECT_FALSE(estimate.remaining(1));
  EXPECT_EQ(*estimate.remaining(0), 0);
}

TEST(RateEstimate, OfConstantWorkIsThatRate) {
  const Trace trace{[](double w) { return 300 * w; }};
  for (const double at : {0.01, 0.1, 0.5, 0.9, 0.99})
    EXPECT_NEAR(trace.ratio(at), 1, at < 0.1 ? 0.05 : 0.01) << "at " << at;
}

// What comes before the first work (photons, trees) counts for nothing.
TEST(RateEstimate, IgnoresASlowStart) {
  const Trace trace{[](double w) { return 200 + 60 * w; }};
  for (const double at : {0.05, 0.3, 0.9}) EXPECT_NEAR(trace.ratio(at), 1, 0.05) << "at " << at;
}

// The first half takes T, the second 10 T. The true remaining time there follows from the formula
// of the header: after another T the old rate still has a weight of 1 / 16, after 3 T of 1 / 256.
TEST(RateEstimate, FollowsAHalfThatIsTenTimesAsDear) {
  const double T = 30;
  const Trace dear{[&](double w) { return w < 0.5 ? 2 * T * w : T + 20 * T * (w - 0.5); }};
  EXPECT_NEAR(dear.ratio(0.49), 1 / 10.0, 0.02);  // nobody can know
  const auto expected = [](double old) { return 1 / (1 - old + 10 * old); };
  EXPECT_NEAR(dear.ratio(0.55), expected(1 / 16.0), 0.02);
  EXPECT_NEAR(dear.ratio(0.65), expected(1 / 256.0), 0.02);
  EXPECT_NEAR(dear.ratio(0.75), 1, 0.02);
  // The mean rate would be wrong by half even at the end.
  const Trace cheap{[&](double w) { return w < 0.5 ? 20 * T * w : 10 * T + 2 * T * (w - 0.5); }};
  EXPECT_NEAR(cheap.ratio(0.49), 0.51 * 20 / (0.01 * 20 + 1), 0.1);
  EXPECT_GT(cheap.ratio(0.6), cheap.ratio(0.9)) << "it falls, if slowly, as the rest is short";
}

// Tiles whose costs are independent and exponential. Weighted by s^3, n of them have a rate as
// certain as that of (integral s^3)^2 / integral s^6 = 7 n / 16 tiles alike; the tiles to come are
// uncertain, too. After half of N, the ratio is off by sqrt((16 / 7 + 1) / (N / 2)): 15 %.
TEST(RateEstimate, ConvergesUnderNoise) {
  constexpr int kTiles = 300, kRuns = 100;
  double squares = 0, errors[3] = {};
  for (int run = 0; run < kRuns; ++run) {
    std::mt19937 rng(static_cast<unsigned>(run));
    std::exponential_distribution<double> cost;
    std::vector<double> ends{0};
    for (int i = 0; i < kTiles; ++i) ends.push_back(ends.back() + cost(rng));
    const Trace trace{[&](double w) {
      const double tile = std::min(w * kTiles, kTiles - 1e-9);
      const auto i = static_cast<std::size_t>(tile);
      return ends[i] + (tile - std::floor(tile)) * (ends[i + 1] - ends[i]);
    }};
    int n = 0;
    for (const double at : {0.1, 0.5, 0.9}) {
      const double ratio = trace.ratio(at, 1.0 / kTiles);
      if (at == 0.5) squares += (ratio - 1) * (ratio - 1);
      errors[n++] += std::abs(ratio - 1) * (trace.seconds(1) - trace.seconds(at));
    }
  }
  EXPECT_NEAR(std::sqrt(squares / kRuns), std::sqrt((16 / 7.0 + 1) / (kTiles / 2.0)), 0.03);
  EXPECT_GT(errors[0], 2 * errors[1]);
  EXPECT_GT(errors[1], 2 * errors[2]);
}

TEST(RateEstimate, DoesNotCountStopsAndRests) {
  RateEstimate stopped, rested, steady;
  for (int i = 0; i < 600; ++i) {
    const double now = 0.1 * i;
    steady.add(now, i);
    stopped.add(i < 300 ? now : now + 3600, i);  // SIGSTOP for an hour
    if (i == 300) rested.rest();
    rested.add(i < 300 ? now : now + 3600, i);  // an hour of writing
    if (i == 302) {
      EXPECT_NEAR(*stopped.rate(), 10, 3) << "at once";
    }
  }
  EXPECT_NEAR(*steady.rate(), 10, 1e-6);
  EXPECT_NEAR(*stopped.rate(), 10, 0.5);
  EXPECT_NEAR(*rested.rate(), 10, 0.05);
}

TEST(RateEstimate, IsFiniteAndNotNegativeWhateverItSees) {
  std::mt19937 rng(1);
  std::uniform_real_distribution<double> any(0, 1);
  RateEstimate estimate;
  double now = 0, work = 0;
  for (int i = 0; i < 10000; ++i) {
    if (any(rng) < 0.5) now += std::pow(10, 8 * any(rng) - 6);
    if (any(rng) < 0.3) work += std::pow(10, 20 * any(rng) - 8);
    if (any(rng) < 0.1) estimate.rest();
    estimate.add(any(rng) < 0.05 ? now - 1 : now, work);
    const auto remaining = estimate.remaining(std::pow(10, 10 * any(rng) - 5));
    ASSERT_TRUE(!remaining || (std::isfinite(*remaining) && *remaining >= 0));
  }
  EXPECT_EQ(*estimate.remaining(-1), 0);
}

}  // namespace
}  // namespace pbrt
