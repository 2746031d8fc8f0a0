#pragma once
// Sums that do not depend on the order of what they add.

namespace pbrt {

// N sums side by side, and what their roundings have lost (Knuth 1969, "Seminumerical Algorithms",
// section 4.2.2, theorem B: what an addition loses is a number of the same type). The loss of an
// addition is at most 2^-53 |sum|. Where all terms are multiples of one number q, so are the
// losses, and they add up without rounding while they stay below 2^53 q together. So n terms have
// one sum, whatever their order, if
//   n |sum| < 2^106 q  at every moment,
// and else its error is below n^2 2^-106 of the greatest |sum|. Terms must be finite, and so must
// be their sums. Zero bytes are empty sums.
template <int N>
struct ExactSums {
  double sum[N] = {};
  double lost[N] = {};

  void add(const double (&x)[N]) {
    for (int i = 0; i < N; ++i) {
      const double total = sum[i] + x[i];
      const double part = total - sum[i];
      lost[i] += (sum[i] - (total - part)) + (x[i] - part);
      sum[i] = total;
    }
  }
  ExactSums& operator+=(const ExactSums& o) {
    add(o.sum);
    for (int i = 0; i < N; ++i) lost[i] += o.lost[i];
    return *this;
  }
  // Rounded once.
  double value(int i) const { return sum[i] + lost[i]; }
};

}  // namespace pbrt
