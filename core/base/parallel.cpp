#include "core/base/parallel.h"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>

#include <atomic>

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

int defaultThreads() {
  return tbb::info::default_concurrency();
}

ThreadLimit::ThreadLimit(int threads) {
  if (threads > 0)
    limit_ = std::make_shared<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                   static_cast<std::size_t>(threads));
}

}  // namespace pbrt
