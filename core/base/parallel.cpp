#include "core/base/parallel.h"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <fstream>
#include <limits>

#include "core/base/control_groups.h"

namespace pbrt {

void parallelFor(std::size_t n, const std::function<void(std::size_t)>& body) {
  std::atomic<std::size_t> ended = 0;
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, n, 1),
      [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) body(i);
        ended.fetch_add(1, std::memory_order_release);
      },
      tbb::simple_partitioner());
  // oneTBB has ordered the bodies before what follows; this says so to ThreadSanitizer, which does
  // not see into it. It orders no two bodies.
  static_cast<void>(ended.load(std::memory_order_acquire));
}

int controlGroupCores(const std::filesystem::path& root) {
  int least = std::numeric_limits<int>::max();
  const auto allow = [&](double quota, double period) {
    const double cores = std::ceil(quota / period);  // a quarter of a core needs a thread, too
    if (cores >= 1 && cores < least) least = static_cast<int>(cores);
  };
  for (const std::filesystem::path& group : controlGroups("cpu", root)) {
    // Microseconds in each period. Without a limit there is a word in place of the first number in
    // version 2, -1 in version 1.
    double quota = 0, period = 0;
    if (std::ifstream(group / "cpu.max") >> quota >> period) allow(quota, period);
    if (std::ifstream(group / "cpu.cfs_quota_us") >> quota &&
        std::ifstream(group / "cpu.cfs_period_us") >> period)
      allow(quota, period);
  }
  return least;
}

int defaultThreads() {
  static const int threads = std::min(tbb::info::default_concurrency(), controlGroupCores());
  return threads;
}

ThreadLimit::ThreadLimit(int threads)
    : limit_(std::make_shared<tbb::global_control>(
          tbb::global_control::max_allowed_parallelism,
          static_cast<std::size_t>(threads > 0 ? threads : defaultThreads()))) {}

}  // namespace pbrt
