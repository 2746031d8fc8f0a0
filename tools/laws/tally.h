#pragma once
// Trials of which a few may fail.

#include "law.h"

namespace pbrt::laws {

// What may go wrong now and then, by rounding at an edge.
class Tally {
 public:
  template <class... Args>
  void expect(bool ok, fmt::format_string<Args...> what, Args&&... args) {
    ++tried_;
    if (ok) return;
    if (wrong_++ == 0) example_ = fmt::format(what, std::forward<Args>(args)...);
  }
  int tried() const { return tried_; }
  void judge(Judge& judge, int allowed) const {
    judge.expect(wrong_ <= allowed, "{} of {} trials fail, and at most {} may; the first: {}",
                 wrong_, tried_, allowed, example_);
  }

 private:
  int tried_ = 0, wrong_ = 0;
  std::string example_;
};

}  // namespace pbrt::laws
