#include "rate_estimate.h"

#include <algorithm>
#include <cmath>

namespace pbrt {

void RateEstimate::add(double now, double work) {
  constexpr double kLongestStep = 2;  // seconds; machines under load come late, too
  if (seen_) active_ += std::clamp(now - *seen_, 0.0, kLongestStep);
  seen_ = now;
  // Work comes in lumps. Each was done since the one before; before the first, who knows since
  // when.
  if (!work_ && work > 0) {
    work_ = work;
    active_ = 0;
  }
  if (!work_ || work <= *work_ || active_ <= stepped_) return;
  // The weights of the rate r(s) at the time s make it 4 / t^4 integral(s^3 r(s) ds, 0 .. t). From
  // a to b, where r was constant, it grows by the part 1 - (a / b)^4 of that constant.
  const double kept = std::pow(stepped_ / active_, 4);
  const double step = (work - *work_) / (active_ - stepped_);
  rate_ = kept * rate_.value_or(0) + (1 - kept) * step;
  work_ = work;
  stepped_ = active_;
}

std::optional<double> RateEstimate::remaining(double work) const {
  if (!(work > 0)) return 0;
  if (!rate_) return {};
  return work / *rate_;
}

}  // namespace pbrt
