#pragma once
// Work on all cores. parallel.cpp and the render loop are the only users of oneTBB.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>

namespace pbrt {

// Calls body(0) ... body(n - 1), in any order and on several threads, and returns when all have
// returned. An exception of a body comes out of here; the bodies not yet begun are then skipped.
void parallelFor(std::size_t n, const std::function<void(std::size_t)>& body);

// How many threads the process may use: one for each core of its affinity mask (taskset, cpusets),
// but no more than the time of so many cores that its control groups leave to it (containers).
int defaultThreads();

// Of how many cores the control groups of this process allow the time, rounded up; the largest
// number if they allow all. `root`: where /proc and /sys/fs/cgroup are.
int controlGroupCores(const std::filesystem::path& root = "/");

// While it lives, no more than this many threads work; 0: defaultThreads(). More than there are
// cores are so many all the same. Where several live, the least counts. The threads are started at
// once, while there is room for them: throws Error, Failure::io, if the system refuses one.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);

 private:
  std::shared_ptr<void> limit_;  // oneTBB's own
};

}  // namespace pbrt
