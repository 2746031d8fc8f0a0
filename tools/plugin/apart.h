#pragma once
// Work that may crash, hang or end the process, done where that does no harm.

#include <functional>
#include <string>

namespace pbrt {

// How it ended.
struct Ending {
  std::string text;  // what it returned
  // Why it did not return, in words: "crashed: Segmentation fault"; empty: it did.
  std::string mishap;
  bool late = false;  // it was still at it when its time was over
};

// Does the work in a copy of this process, and ends that after so many seconds. It may allocate 4
// GiB at most. What it prints goes to standard error. Throws Error, Failure::io, if there can be no
// copy.
Ending runApart(const std::function<std::string()>& work, double seconds);

}  // namespace pbrt
