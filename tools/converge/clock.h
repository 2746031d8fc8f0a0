#pragma once
// How long something took.

#include <sys/resource.h>

#include <chrono>

namespace pbrt {

// Counts from its construction.
class Clock {
 public:
  double seconds() const { return std::chrono::duration<double>(Time::now() - start_).count(); }
  // Of all cores, for this process.
  double cpuSeconds() const { return cpu() - cpuStart_; }

 private:
  using Time = std::chrono::steady_clock;

  static double cpu() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto inSeconds = [](const timeval& t) {
      return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return inSeconds(usage.ru_utime) + inSeconds(usage.ru_stime);
  }

  Time::time_point start_ = Time::now();
  double cpuStart_ = cpu();
};

}  // namespace pbrt
