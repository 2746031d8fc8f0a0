#pragma once
// Polynomials of degree 6 in Bernstein form, with a margin: the function in question lies in c(x) +
// [lo, hi] for x in [0, 1]. A polynomial runs within the range of its ordinates, and is monotone if
// they are.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "shapes/metaballs/lanes.h"

namespace pbrt::metaballs {
inline namespace PBRT_LANES {

// A part of [0, 1] in which a function may be zero, while it is not zero before it.
struct Suspect {
  double a = 0, b = 1;
  double guess = 0.5;    // of the zero
  bool certain = false;  // the function changes its sign in it, and but once to within the margin
};

struct Bernstein {
  static constexpr int D = 6;
  std::array<double, D + 1> c{};
  double lo = 0, hi = 0;
  double rounding = 0;  // what of the margin, on either side, is due to rounding

  // The first suspect at or after `from`; false if the function is nowhere zero there.
  bool suspect(double from, Suspect& s) const {
    double size = hi - lo;
    for (const double x : c) size += std::abs(x);
    if (!(size < std::numeric_limits<double>::infinity())) {  // overflow: nothing is known
      s = {from, 1, 0.5 * (from + 1), false};
      return true;
    }
    Bernstein piece = *this;
    if (from > 0) piece.halve(from, nullptr);
    return piece.search(from, 1, s, 0);
  }

 private:
  // This polynomial becomes its part beyond x; `before` gets the other (de Casteljau 1959).
  void halve(double x, Bernstein* before) {
    if (before) *before = *this;
    for (int k = 1; k <= D; ++k) {
      for (int i = 0; i <= D - k; ++i) c[i] += x * (c[i + 1] - c[i]);
      if (before) before->c[k] = c[0];
    }
  }

  // This is the part over [a, b].
  bool search(double a, double b, Suspect& s, int depth) {
    double least = c[0], most = c[0], falls = c[1] - c[0], rises = falls;
    for (int i = 1; i <= D; ++i) {
      least = std::min(least, c[i]);
      most = std::max(most, c[i]);
      falls = std::min(falls, c[i] - c[i - 1]);
      rises = std::max(rises, c[i] - c[i - 1]);
    }
    if (least + lo > 0 || most + hi < 0) return false;
    if (falls > 0 || rises < 0) {
      bracket(a, b, falls > 0 ? 1 : -1, D * (falls > 0 ? falls : -rises), s);
      return true;
    }
    // Where the margin blurs it there is nothing more to see.
    if (most - least <= 2 * (hi - lo) || depth == 40) {
      s = {a, b, 0.5 * (a + b), false};
      return true;
    }
    Bernstein left;
    halve(0.5, &left);
    const double middle = 0.5 * (a + b);
    return left.search(a, middle, s, depth + 1) || search(middle, b, s, depth + 1);
  }

  // Where a monotone c (sign * c rises by at least `slope` over the piece) has its zero: no farther
  // from it than margin / slope is the function's.
  void bracket(double a, double b, double sign, double slope, Suspect& s) const {
    const double start = sign * c[0], end = sign * c[D];
    // A little more, so that what is beyond the suspect is seen to be excluded.
    double up = (1 + 0x1p-20) * (sign > 0 ? hi : -lo), down = (1 + 0x1p-20) * (sign > 0 ? -lo : hi);
    s.certain = start + up < 0 && end - down > 0;
    double x = start >= 0 ? 0 : 1;
    if (start < 0 && end > 0) {
      double left = 0;
      x = zero(0x1p-5 * (up + down), left);
      up += left, down += left;
    }
    // Beyond its end the zero is at least (distance from zero) / slope away: counts against `up`.
    const double before = std::max(0.0, up + std::min(0.0, end)) / slope;
    const double after = std::max(0.0, down - std::max(0.0, start)) / slope;
    const double w = b - a;
    s.a = a + w * std::max(0.0, x - before);
    s.b = a + w * std::min(1.0, x + after);
    s.guess = a + w * x;
  }

  // Where a monotone c that changes its sign is as small as `enough`; |c| there is `left`. Newton's
  // method, kept in the bracket.
  double zero(double enough, double& left) const {
    // In powers of x: forward differences times binomials.
    const double p[D + 1] = {c[0],
                             6 * (c[1] - c[0]),
                             15 * (c[2] - 2 * c[1] + c[0]),
                             20 * (c[3] - c[0] - 3 * (c[2] - c[1])),
                             15 * (c[4] + c[0] - 4 * (c[3] + c[1]) + 6 * c[2]),
                             6 * (c[5] - c[0] - 5 * (c[4] - c[1]) + 10 * (c[3] - c[2])),
                             c[6] + c[0] - 6 * (c[5] + c[1]) + 15 * (c[4] + c[2]) - 20 * c[3]};
    const bool rising = c[0] < 0;
    double below = 0, above = 1, x = c[0] / (c[0] - c[D]);
    for (int i = 0;; ++i) {
      double f = p[D], df = 0;
      for (int k = D - 1; k >= 0; --k) {
        df = df * x + f;
        f = f * x + p[k];
      }
      left = std::abs(f);
      if (left <= enough || i == 60) return x;
      ((f < 0) == rising ? below : above) = x;
      const double next = x - f / df;
      x = next >= below && next <= above ? next : 0.5 * (below + above);
    }
  }
};

}  // namespace PBRT_LANES
}  // namespace pbrt::metaballs
