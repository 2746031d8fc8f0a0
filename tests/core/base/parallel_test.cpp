#include "core/base/parallel.h"

#include <gtest/gtest.h>
#include <sched.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <thread>
#include <vector>

#include "tests/command.h"

namespace pbrt {
namespace {

namespace fs = std::filesystem;

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

// The most bodies that ran at the same time. They wait for so many, but not for ever.
int mostAtOnce(int wanted) {
  std::atomic<int> now = 0, most = 0;
  const auto patience = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  parallelFor(200, [&](std::size_t) {
    const int here = ++now;
    for (int seen = most; seen < here && !most.compare_exchange_weak(seen, here);) {
    }
    while (most < wanted && std::chrono::steady_clock::now() < patience) std::this_thread::yield();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));  // there would be time for more
    --now;
  });
  return most;
}

TEST(ThreadLimit, IsExactAboveTheNumberOfCoresToo) {
  for (const int n : {1, 2, 3, 7, 20}) {
    const ThreadLimit limit(n);
    EXPECT_EQ(mostAtOnce(n), n);
  }
}

TEST(ThreadLimit, StartsItsThreadsAtOnce) {
  constexpr int kThreads = 30;  // more than another test has
  const auto running = [] {
    return std::distance(fs::directory_iterator("/proc/self/task"), fs::directory_iterator());
  };
  const ThreadLimit limit(kThreads);
  EXPECT_GE(running(), kThreads);
}

TEST(ThreadLimit, TheLeastCounts) {
  const ThreadLimit outer(5), inner(2);
  EXPECT_EQ(mostAtOnce(2), 2);
}

TEST(ThreadLimit, WithoutANumberIsWhatTheProcessMayUse) {
  const ThreadLimit limit(0);
  EXPECT_EQ(mostAtOnce(defaultThreads()), defaultThreads());
}

TEST(DefaultThreads, AreNoMoreThanTheAffinityMaskHas) {
  cpu_set_t mask;
  ASSERT_EQ(sched_getaffinity(0, sizeof mask, &mask), 0);
  EXPECT_GE(defaultThreads(), 1);
  EXPECT_LE(defaultThreads(), CPU_COUNT(&mask));
  EXPECT_EQ(defaultThreads(), std::min(CPU_COUNT(&mask), controlGroupCores()));
}

// A tree of files such as Linux shows.
class ControlGroupCores : public testing::Test {
 protected:
  void write(const std::string& file, const std::string& text) const {
    folder_.write(file, text + '\n');
  }
  int cores() const { return controlGroupCores(folder_.path()); }

 private:
  test::Folder folder_;
};

constexpr int kAll = std::numeric_limits<int>::max();

TEST_F(ControlGroupCores, OfVersion2) {
  EXPECT_EQ(cores(), kAll) << "no groups";
  write("proc/self/cgroup", "0::/batch/job 7");
  EXPECT_EQ(cores(), kAll) << "no limit";
  write("sys/fs/cgroup/batch/job 7/cpu.max", "max 100000");
  EXPECT_EQ(cores(), kAll);
  for (const auto& [quota, threads] :
       {std::pair("200000 100000", 2), {"150000 100000", 2}, {"1000 100000", 1}}) {
    write("sys/fs/cgroup/batch/job 7/cpu.max", quota);
    EXPECT_EQ(cores(), threads) << quota;
  }
  write("sys/fs/cgroup/batch/job 7/cpu.max", "800000 100000");
  write("sys/fs/cgroup/batch/cpu.max", "300000 100000");
  EXPECT_EQ(cores(), 3) << "the group about it holds it, too";
}

// In a container the path is "/", or one that is seen from outside only.
TEST_F(ControlGroupCores, OfAContainer) {
  write("sys/fs/cgroup/cpu.max", "400000 100000");
  for (const char* path : {"0::/", "0::/docker/0123abcd", "0::/../.."}) {
    write("proc/self/cgroup", path);
    EXPECT_EQ(cores(), 4) << path;
  }
}

TEST_F(ControlGroupCores, OfVersion1) {
  write("proc/self/cgroup", "5:memory:/job\n4:cpu,cpuacct:/job\n3:cpuset:/other");
  write("sys/fs/cgroup/cpu/job/cpu.cfs_quota_us", "-1");
  write("sys/fs/cgroup/cpu/job/cpu.cfs_period_us", "100000");
  EXPECT_EQ(cores(), kAll);
  write("sys/fs/cgroup/cpu/job/cpu.cfs_quota_us", "250000");
  EXPECT_EQ(cores(), 3);
  write("sys/fs/cgroup/cpuset/other/cpu.cfs_quota_us", "100000");  // of nobody
  EXPECT_EQ(cores(), 3);
}

TEST_F(ControlGroupCores, IgnoreWhatIsNoNumber) {
  write("proc/self/cgroup", "nonsense\n0::/\n::");
  for (const char* text : {"", "x y", "100000", "0 100000", "-5 100000", "100000 0", "0 0"}) {
    write("sys/fs/cgroup/cpu.max", text);
    EXPECT_EQ(cores(), kAll) << text;
  }
}

}  // namespace
}  // namespace pbrt
