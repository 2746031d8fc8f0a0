// Renders end when they should: passes under a simulated clock and a simulated error.

#include "tools/passes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

namespace pbrt {
namespace {

// A render that was not one: how long each sample takes, and what the error is after n of them.
struct Simulation {
  std::function<double(std::uint32_t)> secondsOf = [](std::uint32_t) { return 0.0; };
  std::function<std::optional<double>(std::uint32_t)> errorOf = [](std::uint32_t) {
    return std::optional<double>();
  };

  double seconds = 0;
  std::uint32_t samples = 0;
  std::vector<Passes::Pass> passes;
  std::vector<double> looks;  // when somebody looked

  void run(const Goal& goal) {
    Passes next(goal);
    double looked = 0;
    while (passes.size() < 100000) {
      const Passes::Pass pass =
          next.next(seconds, seconds - looked, samples ? errorOf(samples) : std::nullopt);
      if (pass.empty()) break;
      for (std::uint32_t s = pass.first; s < pass.end; ++s) seconds += secondsOf(s);
      passes.push_back(pass);
      samples += pass.end - pass.first;
      EXPECT_EQ(next.taken(), samples);
      if (goal.interval && seconds - looked >= *goal.interval) looks.push_back(looked = seconds);
    }
    check(goal);
  }

  // What holds for every goal.
  void check(const Goal& goal) const {
    ASSERT_FALSE(passes.empty());
    ASSERT_LT(passes.size(), 100000U) << "it never ends";
    std::uint32_t end = goal.firstSample;
    for (std::size_t i = 0; i < passes.size(); ++i) {
      const Passes::Pass& p = passes[i];
      EXPECT_EQ(p.first, end) << "a gap or an overlap";
      EXPECT_LE(p.end, goal.endSample);
      if (i > 0) {
        EXPECT_LE(p.end - p.first, end - goal.firstSample) << "more than twice as many";
      }
      EXPECT_TRUE(p.from >= 0 && p.from <= p.to && p.to <= 1) << p.from << " to " << p.to;
      end = p.end;
    }
    EXPECT_EQ(end - goal.firstSample, samples);
  }
};

Goal any() {
  Goal goal;
  goal.endSample = kMostSamples;
  return goal;
}

std::function<double(std::uint32_t)> each(double seconds) {
  return [seconds](std::uint32_t) { return seconds; };
}

// Errors of Monte Carlo: `one` after one sample. One sample tells no variance.
std::function<std::optional<double>(std::uint32_t)> monteCarlo(double one) {
  return [one](std::uint32_t n) { return std::optional(n < 2 ? 0.0 : one / std::sqrt(n)); };
}

TEST(Passes, SamplesAloneAreOnePass) {
  Goal goal;
  goal.firstSample = 3;
  goal.endSample = 1000;
  Simulation s;
  s.run(goal);
  ASSERT_EQ(s.passes.size(), 1U);
  EXPECT_EQ(s.passes[0].first, 3U);
  EXPECT_EQ(s.passes[0].end, 1000U);
  EXPECT_EQ(s.passes[0].from, 0);
  EXPECT_EQ(s.passes[0].to, 1);
}

TEST(Passes, TheFirstOfSeveralIsOneSample) {
  for (const bool time : {false, true}) {
    Goal goal = any();
    goal.endSample = 64;
    (time ? goal.seconds : goal.interval) = 1.0;
    Simulation s{.secondsOf = each(0.01)};
    s.run(goal);
    EXPECT_EQ(s.passes[0].end, 1U);
  }
}

TEST(Passes, TimeEndsAtTheLastWholeSample) {
  for (const double each1 : {0.003, 0.07, 0.3, 1.7}) {
    Goal goal = any();
    goal.seconds = 2;
    Simulation s{.secondsOf = each(each1)};
    s.run(goal);
    // The sums of the clock may round the last one away.
    EXPECT_LE(s.seconds, 2 + 1e-9);
    EXPECT_GT(s.seconds, 2 - each1 - 1e-9) << each1;
    EXPECT_LT(s.passes.size(), 16U) << "doubled, not one by one";
  }
}

TEST(Passes, ASampleLongerThanTheTimeIsTakenNonetheless) {
  Goal goal = any();
  goal.seconds = 2;
  Simulation s{.secondsOf = each(5)};
  s.run(goal);
  EXPECT_EQ(s.samples, 1U);
}

// A pass is planned from the mean so far and at most doubles the samples. If n samples take time in
// proportion to n^(5/4), such a pass ends late by a factor of 2^(1/4) at most. If samples grow
// quicker nothing is late, and further passes fill the gap.
TEST(Passes, TimeIsNearlyKeptWhenSamplesChange) {
  Goal goal = any();
  goal.seconds = 10;
  Simulation slower{.secondsOf = [](std::uint32_t s) { return 1e-3 * std::pow(1 + s, 0.25); }};
  slower.run(goal);
  EXPECT_GT(slower.seconds, 9.9);
  EXPECT_LT(slower.seconds, 10 * std::pow(2, 0.25));
  Simulation quicker{
      .secondsOf = [](std::uint32_t s) { return 1e-2 / (1 + std::min(s, 100U) / 50.0); }};
  quicker.run(goal);
  EXPECT_LE(quicker.seconds, 10 + 1e-9);
  EXPECT_GT(quicker.seconds, 10 - 0.01) << "one sample at the mean cost is what may be missing";
}

TEST(Passes, TimeNeverTakesMoreSamplesThanThereAre) {
  Goal goal;
  goal.firstSample = 5;
  goal.endSample = 105;
  goal.seconds = 1000;
  Simulation s{.secondsOf = each(0.01)};
  s.run(goal);
  EXPECT_EQ(s.samples, 100U);
  EXPECT_EQ(s.passes.back().end, 105U);
  EXPECT_EQ(s.passes.back().to, 1);
  Simulation still;  // a clock that does not move
  still.run(goal);
  EXPECT_EQ(still.samples, 100U);
}

TEST(Passes, TheErrorEndsAtTheFewestSamplesThatReachIt) {
  for (const double one : {0.5, 1.0, 3.3}) {
    Goal goal = any();
    goal.error = 0.01;
    Simulation s{.errorOf = monteCarlo(one)};
    s.run(goal);
    const double needed = std::pow(one / 0.01, 2);
    EXPECT_NEAR(s.samples, needed, 1) << one;
    EXPECT_LE(*s.errorOf(s.samples), 0.01 + 1e-12);
  }
}

TEST(Passes, TheErrorIsNotBelievedBeforeSixteenSamples) {
  Goal goal = any();
  goal.error = 0.5;
  Simulation s{.errorOf = [](std::uint32_t) { return std::optional(0.0); }};
  s.run(goal);
  EXPECT_EQ(s.samples, 16U);
  goal.interval = 3.5;  // passes of other sizes on the way: 1, 1, 1, 2, ...
  Simulation looking{.secondsOf = each(1), .errorOf = s.errorOf};
  looking.run(goal);
  EXPECT_EQ(looking.samples, 16U);
}

// An estimate that dips between the passes is not looked at there, whatever splits them.
TEST(Passes, TheErrorEndsIndependentlyOfTheClock) {
  const auto samples = [](double interval, bool shows) {
    Goal goal = any();
    goal.error = 0.05;
    goal.interval = interval;
    goal.showsError = shows;
    Simulation s{.secondsOf = each(0.9), .errorOf = [](std::uint32_t n) {
                   return std::optional(n % 7 == 3 ? 0.01 : 1 / std::sqrt(n));
                 }};
    s.run(goal);
    return s.samples;
  };
  const std::uint32_t undisturbed = samples(1e9, false);
  EXPECT_NEAR(undisturbed, 400, 1);
  for (const double interval : {0.1, 3.0, 10.0, 50.0})
    for (const bool shows : {false, true})
      EXPECT_EQ(samples(interval, shows), undisturbed) << interval << shows;
}

TEST(Passes, AnErrorThatStaysEndsWithTheSamples) {
  Goal goal;
  goal.endSample = 500;
  goal.error = 1e-6;
  Simulation s{.errorOf = [](std::uint32_t) { return std::optional(0.2); }};
  s.run(goal);
  EXPECT_EQ(s.samples, 500U);
}

TEST(Passes, WhicheverComesFirstEndsIt) {
  Goal goal = any();
  goal.seconds = 1;
  goal.error = 0.1;
  Simulation bySeconds{.secondsOf = each(0.02), .errorOf = monteCarlo(1)};
  bySeconds.run(goal);
  EXPECT_NEAR(bySeconds.samples, 50, 1);
  Simulation byError{.secondsOf = each(0.002), .errorOf = monteCarlo(1)};
  byError.run(goal);
  EXPECT_NEAR(byError.samples, 100, 1);
  goal.endSample = 30;
  Simulation bySamples{.secondsOf = each(0.002), .errorOf = monteCarlo(1)};
  bySamples.run(goal);
  EXPECT_EQ(bySamples.samples, 30U);
}

TEST(Passes, LooksComeWithinOneSampleOfTheirTime) {
  Goal goal;
  goal.endSample = 1000;
  goal.interval = 1;
  Simulation s{.secondsOf = each(0.03)};
  s.run(goal);
  EXPECT_EQ(s.samples, 1000U);
  ASSERT_GE(s.looks.size(), 28U);
  double before = 0;
  for (const double look : s.looks) {
    EXPECT_GE(look - before, 1);
    EXPECT_LE(look - before, 1.03 + 1e-9);
    before = look;
  }
}

TEST(Passes, LooksAtEverySampleIfSamplesTakeLonger) {
  Goal goal;
  goal.endSample = 50;
  goal.interval = 0.01;
  Simulation s{.secondsOf = each(1)};
  s.run(goal);
  EXPECT_EQ(s.looks.size(), 50U);
}

// Some pixels have samples up to 20 of a pass from 12 to 24, others 14 only: first all get those
// up to 24, whatever the time and the error are, then passes go on as before.
TEST(Passes, GoOnWithOneThatWasInterrupted) {
  Goal goal;
  goal.firstSample = 4;
  goal.endSample = 1000;
  goal.error = 0.1;
  goal.seconds = 5;
  Passes passes(goal, 14, 24);
  const Passes::Pass rest = passes.next(100, 100, std::nullopt);
  EXPECT_EQ(rest.first, 14U);
  EXPECT_EQ(rest.end, 24U);
  EXPECT_EQ(passes.taken(), 20U);
  EXPECT_TRUE(passes.next(100, 100, 0.2).empty()) << "the time is over";

  goal.seconds.reset();
  Passes untimed(goal, 14, 24), undisturbed(goal, 24, 24);
  untimed.next(0, 0, std::nullopt);
  EXPECT_EQ(untimed.next(0, 0, 0.2).end, undisturbed.next(0, 0, 0.2).end);

  Goal plain;
  plain.endSample = 64;
  Passes whole(plain, 64, 64);
  EXPECT_TRUE(whole.next(0, 0, std::nullopt).empty());
}

// By hand: variances of 0.01 in values of 0.5: 0.01 / (0.25 + 0.01) each, the root of it is 0.1961;
// one value of ten times the variance in six adds 9 / 6 of that.
TEST(EstimatedError, ByHand) {
  Image image;
  image.window = {{0, 0}, {2, 1}};
  for (const char* name : {"R", "G", "B"}) {
    image.names.emplace_back(name);
    image.channels.emplace_back(2, 0.5F);
  }
  for (const char* name : {"Variance.R", "Variance.G", "Variance.B"}) {
    image.names.emplace_back(name);
    image.channels.emplace_back(2, 0.01F);
  }
  EXPECT_NEAR(estimatedError(image), std::sqrt(0.01 / 0.26), 1e-7);
  image.channels[4][1] = 0.1F;
  EXPECT_NEAR(estimatedError(image), std::sqrt(0.01 / 0.26 * 2.5), 1e-7);
  for (std::size_t c = 3; c < 6; ++c) image.channels[c].assign(2, 0);
  EXPECT_EQ(estimatedError(image), 0);
}

}  // namespace
}  // namespace pbrt
