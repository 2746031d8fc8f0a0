#pragma once
// What a command says about a scene while it reads it.

#include <array>
#include <string>

#include "core/base/error.h"

namespace pbrt {

// Prints diagnostics to standard error, and counts them. A scene that is wrong in the same way a
// thousand times is told so often enough.
class Reports {
 public:
  static constexpr std::size_t kMostShown = 100;  // of each severity

  // Shows what is at least as severe as `least`.
  explicit Reports(Severity least) : least_(least) {}

  void add(const Diagnostic& d);
  Severity least() const { return least_; }
  std::size_t errors() const { return counts_[static_cast<std::size_t>(Severity::error)]; }

 private:
  Severity least_;
  std::array<std::size_t, 3> counts_{};
};

}  // namespace pbrt
