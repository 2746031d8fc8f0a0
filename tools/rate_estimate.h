#pragma once
// How fast work goes, and how long the rest of it takes.

#include <optional>

namespace pbrt {

// The mean rate of work since it began, in which what is recent counts more: work done at the time
// s counts s^3 of t^3, where t is now and both count from the first work that was seen. The law has
// no time of its own, so that it serves renders of seconds and of weeks: whatever was before makes
// up 1 / 16 once the time is twice as long (parts of a picture that are dearer than others), and
// the errors of single steps, if they are independent, fall as the root of their number.
class RateEstimate {
 public:
  // So much work is done so far at a moment, in seconds of any clock. To be called several times a
  // second while work goes on: whoever comes back after a longer time was stopped, and with him the
  // work (SIGSTOP), so that the time between does not count.
  void add(double now, double work);
  // Nothing is worked on until add() is called next; the time between does not count.
  void rest() { seen_.reset(); }

  // Work per second; empty until work was seen to go on.
  std::optional<double> rate() const { return rate_; }
  // Seconds for so much work; finite and not negative.
  std::optional<double> remaining(double work) const;

 private:
  std::optional<double> seen_;  // when add() was called
  double active_ = 0;           // seconds of work since the first was seen
  double stepped_ = 0;          // active_ when there was more work last
  std::optional<double> work_;  // then
  std::optional<double> rate_;
};

}  // namespace pbrt
