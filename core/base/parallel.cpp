#include "core/base/parallel.h"

#include <fmt/format.h>
#include <malloc.h>
#include <sys/resource.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <fstream>
#include <latch>
#include <limits>
#include <thread>
#include <vector>

#include "core/base/control_groups.h"
#include "core/base/error.h"
#include "core/base/file.h"

namespace pbrt {

void parallelFor(std::size_t n, const std::function<void(std::size_t)>& body) {
  std::atomic<std::size_t> ended = 0;
  const auto loop = [&] {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, n, 1),
        [&](const tbb::blocked_range<std::size_t>& range) {
          for (std::size_t i = range.begin(); i < range.end(); ++i) body(i);
          ended.fetch_add(1, std::memory_order_release);
        },
        tbb::simple_partitioner());
  };
  // oneTBB's own arena has a place for each core only, even if more threads are asked for.
  const auto threads = static_cast<int>(
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
  if (threads > tbb::this_task_arena::max_concurrency())
    tbb::task_arena(threads).execute(loop);
  else
    loop();
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

namespace {

// oneTBB ends the process if it cannot start a thread, and starts them when it first needs them,
// when memory may be short. So as many are tried first, all at once, and then oneTBB's are started,
// which it keeps.
void startThreads(int n) {
  // The least of several limits counts.
  n = std::min(n, static_cast<int>(tbb::global_control::active_value(
                      tbb::global_control::max_allowed_parallelism)));
  static std::atomic<int> started = 1;  // the one that runs here
  if (n <= started) return;
  // Where addresses are rationed, a heap for each thread (64 MiB of them, in glibc) is too much.
  if (rlimit addresses{};
      getrlimit(RLIMIT_AS, &addresses) == 0 && addresses.rlim_cur != RLIM_INFINITY)
    mallopt(M_ARENA_MAX, 1);
  std::latch end(1);
  std::vector<std::thread> trial;
  const auto join = [&] {
    end.count_down();
    for (std::thread& thread : trial) thread.join();
  };
  try {
    for (int i = 1; i < n; ++i) trial.emplace_back([&end] { end.wait(); });
  } catch (const std::exception& error) {  // std::system_error, or no memory for one
    join();
    throw Error(fmt::format("the system lets this process start {} threads, not {}: {}",
                            trial.size() + 1, n, reasonOf(error)),
                Failure::io);
  }
  join();
  // oneTBB starts a thread only while there is work for it: bodies that wait for one another, but
  // not for ever, as somebody else's loop may hold some of its threads.
  std::atomic<int> here = 0;
  const auto patience = std::chrono::steady_clock::now() + std::chrono::seconds(1);
  const auto waitForAll = [&](int) {
    ++here;
    while (here < n && std::chrono::steady_clock::now() < patience)
      std::this_thread::sleep_for(std::chrono::microseconds(100));
  };
  tbb::task_arena(n).execute(
      [&] { tbb::parallel_for(0, n, waitForAll, tbb::simple_partitioner()); });
  started = n;
}

}  // namespace

ThreadLimit::ThreadLimit(int threads) {
  const int n = threads > 0 ? threads : defaultThreads();
  limit_ = std::make_shared<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                 static_cast<std::size_t>(n));
  startThreads(n);
}

}  // namespace pbrt
