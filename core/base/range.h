#pragma once
// Interval arithmetic: what a function of real numbers may be over a range of them, rounding
// included. (Moore 1966; the rounding by hand is that of Rump et al. 2009, "Computing predecessor
// and successor in rounding to nearest".)

#include "core/base/math.h"

#if defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__
#error "ranges need NaN and infinities: build without -ffast-math"
#endif

namespace pbrt {

// All real numbers x with lo <= x <= hi; empty unless lo <= hi, so that NaN is empty: where a
// formula has no value. Every function here gives a range that holds its real value for all reals
// in its arguments, and what the same function of double gives for doubles in them. Reals outside
// of a function's domain give nothing: sqrt([-4, 4]) is [0, 2].
struct Range {
  double lo = 0, hi = 0;

  constexpr Range() = default;
  constexpr Range(double x) : lo(x), hi(x) {}  // NOLINT: a number is the range of itself
  constexpr Range(double least, double most) : lo(least), hi(most) {}
  static constexpr Range all() {
    return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  }
  static constexpr Range none() { return std::numeric_limits<double>::quiet_NaN(); }

  bool empty() const { return !(lo <= hi); }
  bool contains(double x) const { return lo <= x && x <= hi; }
  bool bounded() const { return std::isfinite(lo) && std::isfinite(hi); }
  double width() const { return hi - lo; }
  double middle() const { return 0.5 * lo + 0.5 * hi; }
  // The greatest absolute value.
  double magnitude() const { return std::max(-lo, hi); }

  friend Range operator-(const Range& x) { return {-x.hi, -x.lo}; }
  friend Range operator+(const Range& x, const Range& y) {
    return outward(x.lo + y.lo, x.hi + y.hi);
  }
  friend Range operator-(const Range& x, const Range& y) {
    return outward(x.lo - y.hi, x.hi - y.lo);
  }
  friend Range operator*(const Range& x, const Range& y) {
    return hull(x, y, x.lo * y.lo, x.lo * y.hi, x.hi * y.lo, x.hi * y.hi);
  }
  friend Range operator/(const Range& x, const Range& y) {
    if (y.contains(0)) return x.empty() ? x : all();
    return hull(x, y, x.lo / y.lo, x.lo / y.hi, x.hi / y.lo, x.hi / y.hi);
  }
  Range& operator+=(const Range& x) { return *this = *this + x; }
  Range& operator-=(const Range& x) { return *this = *this - x; }
  Range& operator*=(const Range& x) { return *this = *this * x; }
  Range& operator/=(const Range& x) { return *this = *this / x; }

  friend Range abs(const Range& x) {
    return x.lo >= 0 ? x : x.hi <= 0 ? -x : Range(0, x.magnitude());
  }
  friend Range sqr(const Range& x) {
    const Range a = abs(x);
    return notBelow(0, outward(a.lo * a.lo, a.hi * a.hi));
  }
  friend Range sqrt(const Range& x) {
    if (!(x.hi >= 0)) return none();
    return notBelow(0, outward(std::sqrt(std::max(x.lo, 0.0)), std::sqrt(x.hi)));
  }
  friend Range min(const Range& x, const Range& y) {
    if (x.empty() || y.empty()) return none();
    return {std::min(x.lo, y.lo), std::min(x.hi, y.hi)};
  }
  friend Range max(const Range& x, const Range& y) {
    if (x.empty() || y.empty()) return none();
    return {std::max(x.lo, y.lo), std::max(x.hi, y.hi)};
  }
  // Those of the C library are taken to be off by less than 3 units in the last place: those of
  // glibc are below one (its manual, "Known Maximum Errors in Math Functions").
  friend Range exp(const Range& x) { return notBelow(0, library(std::exp(x.lo), std::exp(x.hi))); }
  friend Range log(const Range& x) {
    if (!(x.hi > 0)) return none();
    return library(std::log(std::max(x.lo, 0.0)), std::log(x.hi));
  }
  friend Range sin(const Range& x) {
    if (x.width() < kThin) return waveAbout(std::sin(x.middle()), x);
    return wave(x, 0.25, std::sin(x.lo), std::sin(x.hi));
  }
  friend Range cos(const Range& x) {
    if (x.width() < kThin) return waveAbout(std::cos(x.middle()), x);
    return wave(x, 0, std::cos(x.lo), std::cos(x.hi));
  }

 private:
  // A double result is off by half a unit in the last place at most: less than
  // 2^-53 (1 + 2^-51) of itself, or, where it is subnormal or taken for zero, kTiny.
  static constexpr double kUnit = 0x1.0000000000002p-53, kTiny = 0x1p-1022;
  static constexpr double kLargest = std::numeric_limits<double>::max();

  // What overflows was larger than all doubles, though not infinite.
  static Range outward(double lo, double hi, double relative = kUnit) {
    lo = std::min(lo, kLargest);
    hi = std::max(hi, -kLargest);
    return {lo - (relative * std::abs(lo) + kTiny), hi + (relative * std::abs(hi) + kTiny)};
  }
  static Range library(double lo, double hi) { return outward(lo, hi, 8 * kUnit); }
  static Range notBelow(double least, Range x) {
    x.lo = std::max(x.lo, least);
    return x;
  }
  // The four results at the ends. Zero times infinity, or two infinities, is no number: their sum
  // shows it, and anything may be.
  static Range hull(const Range& x, const Range& y, double a, double b, double c, double d) {
    const double sum = a + b + c + d;
    if (std::isnan(sum)) return x.empty() || y.empty() ? none() : all();
    return outward(std::min(std::min(a, b), std::min(c, d)),
                   std::max(std::max(a, b), std::max(c, d)));
  }
  // Over less than this, the slope of a wave, at most 1, tells enough from the middle.
  static constexpr double kThin = 0x1p-40;
  static Range waveAbout(double middle, const Range& x) {
    const Range r = library(middle - x.width(), middle + x.width());
    return {std::max(r.lo, -1.0), std::min(r.hi, 1.0)};
  }
  // cos(x - 2 pi peak): 1 where x / 2 pi - peak is an integer, -1 half a turn away; `a` and `b` are
  // its values at the ends. The turns are off by less than 2^-50 of themselves.
  static Range wave(const Range& x, double peak, double a, double b) {
    if (x.empty()) return none();
    constexpr double turn = 0.5 * std::numbers::inv_pi;
    const double slack = 0x1p-48 * (1 + turn * x.magnitude());
    if (!(x.width() * turn < 1 - slack && slack < 0.1)) return {-1, 1};
    const double from = turn * x.lo - peak - slack, to = turn * x.hi - peak + slack;
    Range r = library(std::min(a, b), std::max(a, b));
    if (std::floor(to) >= from) r.hi = 1;
    if (std::floor(to - 0.5) >= from - 0.5) r.lo = -1;
    return {std::max(r.lo, -1.0), std::min(r.hi, 1.0)};
  }
};

// The smallest that holds both.
inline Range hull(const Range& x, const Range& y) {
  return {std::min(x.lo, y.lo), std::max(x.hi, y.hi)};
}

// x^n by squaring, for n >= 0.
template <class T>
T power(T x, int n) {
  T r(1);
  for (; n > 0; n /= 2, x = x * x)
    if (n % 2) r = r * x;
  return r;
}

// x^n. Odd powers rise all along, even ones with |x|.
inline Range pow(const Range& x, int n) {
  if (n < 0) return 1 / pow(x, -n);
  const Range a = n % 2 ? x : abs(x);
  const Range r{power(Range(a.lo), n).lo, power(Range(a.hi), n).hi};
  return n % 2 ? r : Range(std::max(r.lo, 0.0), r.hi);
}

}  // namespace pbrt
