#pragma once
// What a plug-in does wrong, and where.

#include <unistd.h>

#include <cstdlib>
#include <stdexcept>

#include "core/plugin/plugin.h"

namespace pbrt {

class Fault {
 public:
  explicit Fault(Params& p)
      : kind_(p.choice("fault", kKinds, "none", "what goes wrong")),
        from_(p.number("from", -1e30F, "the least x at which it does")),
        to_(p.number("to", 1e30F, "the greatest")) {
    if (p.flag("making", false, "whether it does so when it is made")) number(0);
  }

  // At x, in whatever space: not a number, if that is what goes wrong; else 1.
  float number(double x) const {
    if (kind_ == "none" || x < from_ || x > to_) return 1;
    if (kind_ == "nan") return std::nanf("");
    if (kind_ == "infinite") return kInfinity;
    if (kind_ == "throws") throw std::runtime_error("no such luck");
    if (kind_ == "throws-int") throw 7;
    if (kind_ == "throws-error") throw Error("no such ray");
    if (kind_ == "eats-memory") throw std::bad_alloc();
    while (kind_ == "hangs") pause();
    if (kind_ == "null") return *static_cast<volatile float*>(nothing_);
    if (kind_ == "aborts") std::abort();
    if (kind_ == "divides") return static_cast<float>(100 / *static_cast<volatile int*>(&zero_));
    return static_cast<float>(overflow(0));
  }

 private:
  static constexpr std::array kKinds = std::to_array<std::string_view>(
      {"none", "nan", "infinite", "throws", "throws-int", "throws-error", "eats-memory", "hangs",
       "null", "aborts", "divides", "overflows"});

  // Fills the stack.
  static int overflow(int depth) {
    volatile char frame[1000] = {};
    return depth < 0 ? frame[0] : overflow(depth + 1) + frame[depth % 1000];
  }

  std::string kind_;
  float from_, to_;
  void* nothing_ = nullptr;
  mutable int zero_ = 0;
};

}  // namespace pbrt
