#include "passes.h"

#include <algorithm>
#include <cmath>

#include "tools/compare/metrics.h"

namespace pbrt {

double estimatedError(const Image& image) {
  std::vector<double> relative;
  for (const char* c : {"R", "G", "B"}) {
    const std::vector<float>& values = *image.channel(c);
    const std::vector<float>& variances = *image.channel(std::string("Variance.") + c);
    for (std::size_t i = 0; i < values.size(); ++i)
      relative.push_back(variances[i] / (sqr(double{values[i]}) + 0.01));
  }
  return std::sqrt(trimmedMean(std::move(relative)));
}

Passes::Pass Passes::next(double seconds, double sinceLook, std::optional<double> error) {
  // Fewer samples may not have met what is rare and bright yet.
  constexpr std::uint32_t kEnoughForVariance = 16;
  constexpr double kErrorEvery = 10;  // seconds

  const std::uint32_t done = taken();
  const std::uint32_t left = goal_.endSample - end_;
  double part = static_cast<double>(done) / std::max(1U, done + left);
  if (!goal_.seconds && !goal_.error && !goal_.interval && !goal_.showsError && !goal_.evenly) {
    const Pass pass{end_, goal_.endSample, part, 1};
    end_ = pass.end;
    return pass;
  }
  // The first tells how long a sample takes; each further pass at most doubles what there is, since
  // it is planned from what was seen.
  const double perSample = seconds / std::max(1U, done);
  double wanted = std::min(left, std::max(1U, done));
  double whole = done + left;
  if (end_ < passEnd_) {
    wanted = passEnd_ - end_;
  } else if (done > 0) {
    if (goal_.error && error) {
      // The error falls with the root of the number of samples.
      const double needed = done * std::pow(*error / *goal_.error, 2);
      if (end_ < errorAt_)  // the clock has split this pass
        wanted = errorAt_ - end_;
      else if (done < kEnoughForVariance)
        wanted = std::min(wanted, static_cast<double>(kEnoughForVariance - done));
      else if (*error <= *goal_.error)
        wanted = 0;
      else
        wanted = std::min(wanted, std::max(1.0, std::ceil(needed - done)));
      errorAt_ = end_ + static_cast<std::uint32_t>(wanted);
      whole = std::min(whole, std::max(needed, double{kEnoughForVariance}));
    }
    if (goal_.seconds) {
      const double room = std::max(0.0, (*goal_.seconds - seconds) / perSample);
      wanted = std::min(wanted, room);
      whole = std::min(whole, done + room);
    }
    if (goal_.interval)
      wanted = std::min(wanted, std::max(1.0, (*goal_.interval - sinceLook) / perSample));
    if (goal_.showsError) wanted = std::min(wanted, std::max(1.0, kErrorEvery / perSample));
    part = std::min(1.0, done / std::max(1.0, whole));
  }
  const Pass pass{end_, end_ + static_cast<std::uint32_t>(wanted), part,
                  std::min(1.0, (done + wanted) / std::max(1.0, whole))};
  end_ = pass.end;
  return pass;
}

}  // namespace pbrt
