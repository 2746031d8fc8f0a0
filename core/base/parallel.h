#pragma once
// Work on all cores. parallel.cpp and the render loop are the only users of oneTBB.

#include <cstddef>
#include <functional>
#include <memory>

namespace pbrt {

// Calls body(0) ... body(n - 1), in any order and on several threads, and returns when all have
// returned. An exception of a body comes out of here; the bodies not yet begun are then skipped.
void parallelFor(std::size_t n, const std::function<void(std::size_t)>& body);

// How many threads the process may use.
int defaultThreads();

// While it lives, no more than this many threads work; 0: as many as the process may use. They are
// started at once, while there is room for them: throws Error if the system refuses one.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);

 private:
  std::shared_ptr<void> limit_;  // oneTBB's own
};

}  // namespace pbrt
