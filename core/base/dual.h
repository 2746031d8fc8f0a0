#pragma once
// Automatic differentiation, forward mode: numbers that carry their partial derivatives along.
// (Wengert 1964.)

#include <algorithm>
#include <array>

#include "core/base/range.h"

namespace pbrt {

// A value and its N partial derivatives, over double, over Range (what both may be in a range of
// places), or over Dual itself (second derivatives). A plain number is constant. Where abs, min or
// max have a kink, a derivative over double is one of those on either side, and one over Range
// holds both: the mean value theorem holds over kinks, too (Lebourg 1975). One over Range is
// bounded only if the function is continuous there, and as steep as that at most.
template <class S, int N = 3>
struct Dual {
  S v{};
  std::array<S, N> d{};

  constexpr Dual() = default;
  constexpr Dual(double x) : v(x) {}  // NOLINT: a number is constant
  constexpr Dual(const S& x, const std::array<S, N>& slopes) : v(x), d(slopes) {}

  friend Dual operator-(const Dual& a) {
    return make(-a.v, [&](int i) { return -a.d[i]; });
  }
  friend Dual operator+(const Dual& a, const Dual& b) {
    return make(a.v + b.v, [&](int i) { return a.d[i] + b.d[i]; });
  }
  friend Dual operator-(const Dual& a, const Dual& b) {
    return make(a.v - b.v, [&](int i) { return a.d[i] - b.d[i]; });
  }
  friend Dual operator*(const Dual& a, const Dual& b) {
    return make(a.v * b.v, [&](int i) { return a.d[i] * b.v + a.v * b.d[i]; });
  }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const S q = a.v / b.v;
    return make(q, [&](int i) { return (a.d[i] - q * b.d[i]) / b.v; });
  }
  friend Dual operator+(const Dual& a, double b) { return {a.v + b, a.d}; }
  friend Dual operator+(double a, const Dual& b) { return {a + b.v, b.d}; }
  friend Dual operator-(const Dual& a, double b) { return {a.v - b, a.d}; }
  friend Dual operator-(double a, const Dual& b) { return a + -b; }
  friend Dual operator*(const Dual& a, double b) { return a.chain(a.v * b, S(b)); }
  friend Dual operator*(double a, const Dual& b) { return b * a; }
  friend Dual operator/(const Dual& a, double b) {
    return make(a.v / b, [&](int i) { return a.d[i] / b; });
  }
  friend Dual operator/(double a, const Dual& b) {
    const S q = a / b.v;
    return b.chain(q, -q / b.v);
  }
  template <class B>
  Dual& operator+=(const B& b) {
    return *this = *this + b;
  }
  template <class B>
  Dual& operator-=(const B& b) {
    return *this = *this - b;
  }
  template <class B>
  Dual& operator*=(const B& b) {
    return *this = *this * b;
  }
  template <class B>
  Dual& operator/=(const B& b) {
    return *this = *this / b;
  }

  friend Dual sqr(const Dual& a) { return a.chain(sqr(a.v), 2 * a.v); }
  friend Dual pow(const Dual& a, int n) {
    if (n == 0) return 1;
    return a.chain(whole(a.v, n), n * whole(a.v, n - 1));
  }
  friend Dual sqrt(const Dual& a) {
    using std::sqrt;
    const S r = sqrt(a.v);
    return a.chain(r, 0.5 / r);
  }
  friend Dual exp(const Dual& a) {
    using std::exp;
    const S e = exp(a.v);
    return a.chain(e, e);
  }
  friend Dual log(const Dual& a) {
    using std::log;
    return a.chain(log(a.v), 1 / a.v);
  }
  friend Dual sin(const Dual& a) {
    using std::cos, std::sin;
    return a.chain(sin(a.v), cos(a.v));
  }
  friend Dual cos(const Dual& a) {
    using std::cos, std::sin;
    return a.chain(cos(a.v), -sin(a.v));
  }
  friend Dual abs(const Dual& a) {
    using std::abs;
    if constexpr (std::is_same_v<S, Range>)
      if (a.v.contains(0)) return make(abs(a.v), [&](int i) { return hull(a.d[i], -a.d[i]); });
    return max(a, -a);
  }
  friend Dual min(const Dual& a, const Dual& b) {
    using std::min;
    if constexpr (std::is_same_v<S, Range>) {
      // Where one has no value, neither has min: the other may be chosen only where both do.
      if (a.v.hi < b.v.lo && b.bounded()) return a;
      if (b.v.hi < a.v.lo && a.bounded()) return b;
      return make(min(a.v, b.v), [&](int i) { return hull(a.d[i], b.d[i]); });
    } else {
      return a.number() < b.number() || std::isnan(a.number()) ? a : b;
    }
  }
  friend Dual max(const Dual& a, const Dual& b) { return -min(-a, -b); }

  // The innermost value.
  double number() const requires(!std::is_same_v<S, Range>) {
    if constexpr (std::is_floating_point_v<S>)
      return v;
    else
      return v.number();
  }

 private:
  template <class Slope>
  static Dual make(const S& value, const Slope& slope) {
    Dual r;
    r.v = value;
    for (int i = 0; i < N; ++i) r.d[i] = slope(i);
    return r;
  }
  bool bounded() const requires std::is_same_v<S, Range> {
    return std::ranges::all_of(d, [](const Range& slope) { return slope.bounded(); });
  }
  // A function with this value and this slope here.
  Dual chain(const S& value, const S& slope) const {
    return make(value, [&](int i) { return slope * d[i]; });
  }
  static S whole(const S& x, int n) {
    if constexpr (std::is_floating_point_v<S>)
      return n < 0 ? 1 / power(x, -n) : power(x, n);
    else
      return pow(x, n);
  }
};

}  // namespace pbrt
