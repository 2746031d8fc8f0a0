#pragma once
// When a render ends, and the passes over the film that lead there.

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>

#include "core/base/image.h"

namespace pbrt {

constexpr std::uint32_t kMostSamples = std::numeric_limits<std::int32_t>::max();  // of a pixel

// What ends a render, whichever comes first. Samples are counted as the sampler does, from 0.
struct Goal {
  std::uint32_t firstSample = 0;
  std::uint32_t endSample = 1;     // one past the last
  std::optional<double> seconds;   // wall time of rendering
  std::optional<double> error;     // estimatedError()
  std::optional<double> interval;  // seconds between looks at the picture; ends nothing
  bool showsError = false;         // the error is to be estimated now and then; ends nothing
  bool evenly = false;  // few samples first, for who stops it and looks at it; ends nothing
};

// The relative error of a picture as its own channels Variance.* have it: the root of relMSE
// (tools/compare/metrics.h) with the variance of each pixel in place of its squared error. An
// estimate: too large for samplers better than random, too small while rare bright light is missed.
double estimatedError(const Image& image);

// Splits a render into passes so that its ends and looks fall between two of them: only there have
// all pixels the same samples. How it is split does not change the picture.
class Passes {
 public:
  explicit Passes(const Goal& goal) : Passes(goal, goal.firstSample, goal.firstSample) {}
  // Goes on where each pixel has the samples before `end`, and some have others before `passEnd`,
  // to which the first pass then brings all of them. Neither is beyond the goal's end.
  Passes(const Goal& goal, std::uint32_t end, std::uint32_t passEnd)
      : goal_(goal), end_(end), passEnd_(passEnd) {}

  struct Pass {
    std::uint32_t first = 0, end = 0;  // samples
    double from = 0, to = 0;           // the part of the whole render, from 0 to 1, that it is
    bool empty() const { return first == end; }
  };
  // The next pass, the last being done. Empty: the goal is reached. `seconds`: since the start,
  // all runs together; `sinceLook`: since the last look; `error`: the estimate, if it is known.
  Pass next(double seconds, double sinceLook, std::optional<double> error);

  // One past the sample at which the error decides next: independent of the clock, unless
  // Goal::seconds ends a pass, so that a render ends by its error where any other would.
  std::uint32_t errorAt() const { return std::max(errorAt_, end_); }

  // Samples per pixel up to the end of the pass that next() gave last.
  std::uint32_t taken() const { return end_ - goal_.firstSample; }

 private:
  Goal goal_;
  std::uint32_t end_;
  std::uint32_t passEnd_;
  std::uint32_t errorAt_ = 0;
};

}  // namespace pbrt
