#pragma once
// Samples that went wrong: a plug-in threw, or gave what is no number. They count as black, and the
// picture goes on without them.

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "core/base/math.h"
#include "core/plugin/culprit.h"

namespace pbrt {

// A sample of the picture.
struct SamplePlace {
  Point2i pixel{0};
  std::uint32_t sample = 0;  // the number within its pixel
  int block = 0;             // > 1: a block of so many by so many pixels; 0: nowhere
};

struct Fault {
  SamplePlace at;
  std::string thrown;                   // its text; empty: the sample is not a number, or infinite
  const PluginCode* culprit = nullptr;  // null: not known
};

// The faults of a render; entered from many threads at once.
class FaultLog {
 public:
  static constexpr std::size_t kKept = 16;

  void add(Fault fault);
  // What is thrown just now, in a handler.
  void addThrown(const SamplePlace& at);
  // Those of the runs that this one goes on from.
  void addEarlier(std::uint64_t count) { count_ += count; }

  std::uint64_t count() const { return count_; }
  bool outOfMemory() const { return outOfMemory_; }
  // The first of this run, kKept at most: those of the lowest samples, of these the upper pixels
  // first, whatever thread found them when.
  std::vector<Fault> first() const;
  // Asks who gave what is no number, for those that are kept; again only where nobody was found.
  void locate(const std::function<const PluginCode*(const SamplePlace&)>& search);

 private:
  std::atomic<std::uint64_t> count_ = 0;
  std::atomic<bool> outOfMemory_ = false;
  mutable std::mutex mutex_;
  std::vector<Fault> first_;  // sorted
};

// For people: how many, and where and what the first is. Empty if there is none.
std::string describe(const FaultLog& faults);

// The sample that this thread works on, for who tells of a crash: a handler of signals may ask.
extern constinit thread_local SamplePlace currentSample __attribute__((tls_model("initial-exec")));

}  // namespace pbrt
