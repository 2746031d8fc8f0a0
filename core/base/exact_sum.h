#pragma once
// Sums that do not depend on the order of what they add.

namespace pbrt {

// A sum and what its roundings have lost (Knuth 1969, "Seminumerical Algorithms", section 4.2.2,
// theorem B): together they hold the exact sum, in whatever order it was added up, as long as its
// terms are multiples of one number q and stay below 2^104 q. Beyond that the error is below
// 2^-104 of the sum of the terms' magnitudes. Zero bytes are an empty sum.
struct ExactSum {
  double sum = 0;
  double lost = 0;

  void add(double x) {
    const double total = sum + x;
    const double part = total - sum;
    lost += (sum - (total - part)) + (x - part);
    sum = total;
  }
  ExactSum& operator+=(const ExactSum& o) {
    add(o.sum);
    lost += o.lost;
    return *this;
  }
  // Rounded once.
  double value() const { return sum + lost; }
};

}  // namespace pbrt
