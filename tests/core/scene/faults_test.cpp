// What is kept of samples that failed does not depend on who found them when.

#include "core/scene/faults.h"

#include <gmock/gmock.h>

#include <thread>

#include "core/base/rng.h"

namespace pbrt {
namespace {

using testing::HasSubstr;

Fault faultAt(int x, int y, std::uint32_t sample, std::string thrown = "") {
  return {{{x, y}, sample, 1}, std::move(thrown)};
}

TEST(FaultLog, KeepsTheFirstOfManyThreads) {
  FaultLog log;
  std::vector<std::thread> threads;
  constexpr int kThreads = 4, kEach = 500;
  for (int t = 0; t < kThreads; ++t)
    threads.emplace_back([&, t] {
      for (int i = kEach - 1; i >= 0; --i) {  // the last first
        const int n = i * kThreads + t;       // its place in the order: sample, row, column
        log.add(faultAt(n % 10, n / 10 % 10, static_cast<std::uint32_t>(n / 100)));
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(log.count(), kThreads * kEach);
  const std::vector<Fault> first = log.first();
  ASSERT_EQ(first.size(), FaultLog::kKept);
  for (int n = 0; n < static_cast<int>(FaultLog::kKept); ++n) {
    EXPECT_EQ(first[n].at.pixel, Point2i(n % 10, n / 10));
    EXPECT_EQ(first[n].at.sample, 0U);
  }
}

TEST(FaultLog, TellsOfTheFirst) {
  FaultLog log;
  EXPECT_EQ(describe(log), "");
  log.addEarlier(2);
  EXPECT_EQ(describe(log), "2 samples failed and count as black, all of them before this run");
  log.add(faultAt(12, 7, 3));
  log.add(faultAt(1, 9, 2, "no such ray"));
  EXPECT_EQ(describe(log),
            "4 samples failed and count as black; first: pixel (1, 9), sample 2: some part threw: "
            "no such ray");
}

TEST(FaultLog, AsksWhoGaveWhatIsNoNumber) {
  FaultLog log;
  log.add(faultAt(12, 7, 3));
  log.add(faultAt(1, 9, 2, "no such ray"));
  const PluginCode poison{0, 0, "materials/poison", "lib/poison.so"};
  int asked = 0;
  const auto search = [&](const SamplePlace& at) {
    ++asked;
    EXPECT_EQ(at.sample, 3U);
    return &poison;
  };
  log.locate(search);
  log.locate(search);
  EXPECT_EQ(asked, 1);
  EXPECT_EQ(log.first()[1].culprit, &poison);
}

TEST(FaultLog, KnowsWhenMemoryIsOut) {
  FaultLog log;
  const auto thrown = [&](const auto& what) {
    try {
      throw what;
    } catch (...) {
      log.addThrown({{1, 2}, 3, 1});
    }
  };
  thrown(std::runtime_error("bad luck"));
  EXPECT_FALSE(log.outOfMemory());
  EXPECT_EQ(log.first()[0].thrown, "bad luck");
  thrown(std::bad_alloc());
  EXPECT_TRUE(log.outOfMemory());
  thrown(7);
  EXPECT_EQ(log.count(), 3U);
}

}  // namespace
}  // namespace pbrt
