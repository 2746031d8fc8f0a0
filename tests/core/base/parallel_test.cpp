#include "core/base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

namespace pbrt {
namespace {

TEST(ParallelFor, CallsEveryIndexOnce) {
  std::vector<int> calls(10000);
  parallelFor(calls.size(), [&](std::size_t i) { ++calls[i]; });
  EXPECT_EQ(calls, std::vector<int>(calls.size(), 1));
  parallelFor(0, [](std::size_t) { FAIL(); });
}

TEST(ParallelFor, HandsOnAnException) {
  EXPECT_THROW(parallelFor(100,
                           [](std::size_t i) {
                             if (i == 40) throw std::out_of_range("40");
                           }),
               std::out_of_range);
}

// The most bodies that ran at the same time.
int mostAtOnce() {
  std::atomic<int> now = 0, most = 0;
  parallelFor(50, [&](std::size_t) {
    const int here = ++now;
    for (int seen = most; seen < here && !most.compare_exchange_weak(seen, here);) {
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    --now;
  });
  return most;
}

TEST(ThreadLimit, BoundsWhatRunsAtOnceWhileItLives) {
  const int all = mostAtOnce();
  {
    const ThreadLimit limit(1), none(0);
    EXPECT_EQ(mostAtOnce(), 1);
  }
  if (std::thread::hardware_concurrency() < 2 || all < 2) GTEST_SKIP() << "one thread only";
  EXPECT_GT(mostAtOnce(), 1);
}

}  // namespace
}  // namespace pbrt
