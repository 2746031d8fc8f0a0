#pragma once
// The first crossing of a ray and metaballs in 113-bit arithmetic, over all atoms, with no cells:
// bisection of the ray's own t, where an interval is dropped or a root called unique only by
// proof. Slow, and written apart from what it judges.

#include <optional>
#include <vector>

#include "core/base/ray.h"
#include "core/base/rng.h"
#include "shapes/metaballs/cells.h"

namespace pbrt::metaballs::test {

__extension__ typedef __float128 Quad;

inline Quad abs(Quad x) {
  return x < 0 ? -x : x;
}

// Taylor series of x / 2^12, then squared twelve times: relative error below 1e-28.
inline Quad exp(Quad x) {
  x /= 4096;
  Quad sum = 1;
  for (int i = 10; i > 0; --i) sum = 1 + x * sum / i;
  for (int i = 0; i < 12; ++i) sum *= sum;
  return sum;
}

class Oracle {
 public:
  struct Range {
    Quad lo = 0, hi = 0;
    void add(Quad x, Quad y) { lo += x < y ? x : y, hi += x < y ? y : x; }
    void widen(Quad e) { lo -= e, hi += e; }
    bool holdsZero() const { return lo <= 0 && hi >= 0; }
  };

  Oracle(const Field& field, const ObjectRay& ray) : kernel_(field.kernel()) {
    Quad dd = 0;
    for (int i = 0; i < 3; ++i) dd += Quad(ray.d[i]) * ray.d[i];
    Quad first = ray.tMax, last = ray.tMin;
    for (const Atom& atom : field.atoms()) {
      Quad dv = 0, vv = 0;
      for (int i = 0; i < 3; ++i) {
        const Quad v = Quad(atom.centre[i]) - ray.o[i];
        dv += v * ray.d[i];
        vv += v * v;
      }
      const Quad h2 = Quad(atom.radius) * atom.radius;
      const Quad rho2 = vv - dv * dv / dd;
      if (rho2 >= h2) continue;
      const Line line{dv / dd, rho2 / h2, dd / h2, atom.weight};
      const Quad reach = 1.000001 * std::sqrt(static_cast<double>((h2 - rho2) / dd));
      first = std::min(first, line.closest - reach);
      last = std::max(last, line.closest + reach);
      lines_.push_back(line);
      magnitude_ += abs(atom.weight);
      finest_ = lines_.size() == 1 ? reach : std::min(finest_, reach);
    }
    first_ = std::max<Quad>(first, ray.tMin);
    last_ = std::min<Quad>(last, ray.tMax);
  }

  // Empty: there is certainly no crossing. What is undecided at 1e-20 of the shortest support
  // counts as one.
  std::optional<Quad> first() const {
    if (lines_.empty() || !(first_ < last_)) return {};
    return search(first_, last_);
  }
  Quad value(Quad t) const { return over(t, t).first.lo; }
  Quad slope(Quad t) const { return over(t, t).second.lo; }
  // Sum of |weight| of the atoms that the ray meets: the scale of rounding.
  Quad magnitude() const { return 1 + magnitude_; }

 private:
  struct Line {
    Quad closest, rho2, scale, weight;  // q = rho2 + scale (t - closest)^2
  };
  // K and K' at q.
  std::pair<Quad, Quad> kernel(Quad q) const {
    if (q >= 1) return {0, 0};
    const Quad a = 1 - q;
    if (kernel_ == Kernel::gaussian) {
      const Quad e = exp(-Gaussian::kB * q);
      return {e - exp(-Gaussian::kB), -Gaussian::kB * e};
    }
    if (kernel_ == Kernel::blob) return {a * a, -2 * a};
    return {a * a * a, -3 * a * a};
  }
  std::pair<Range, Range> over(Quad t0, Quad t1) const {
    Range value{-1, -1}, slope;
    for (const Line& l : lines_) {
      const Quad a = t0 - l.closest, b = t1 - l.closest;
      const Quad near = a > 0 ? a : b < 0 ? b : 0, far = abs(a) > abs(b) ? a : b;
      const auto [k0, d0] = kernel(l.rho2 + l.scale * near * near);
      const auto [k1, d1] = t0 == t1 ? std::pair(k0, d0) : kernel(l.rho2 + l.scale * far * far);
      value.add(l.weight * k0, l.weight * k1);
      const Quad c = 2 * l.weight * l.scale;
      Quad lo = c * d0 * a, hi = lo;
      for (const Quad x : {c * d0 * b, c * d1 * a, c * d1 * b}) {
        lo = std::min(lo, x);
        hi = std::max(hi, x);
      }
      slope.add(lo, hi);
    }
    return {value, slope};
  }
  std::optional<Quad> search(Quad t0, Quad t1) const {
    auto [value, slope] = over(t0, t1);
    const Quad rounding = 1e-24 * magnitude();
    value.widen(rounding);
    if (!value.holdsZero()) return {};
    const Quad middle = (t0 + t1) / 2, half = (t1 - t0) / 2;
    const Quad steepest = std::max(abs(slope.lo), abs(slope.hi));
    const Quad f = this->value(middle);
    if (abs(f) > steepest * half + rounding) return {};
    if (slope.lo > 0 || slope.hi < 0) {
      if ((this->value(t0) < 0) == (this->value(t1) < 0)) return {};
      const bool rising = slope.lo > 0;
      for (int i = 0; i < 90; ++i) {
        const Quad m = (t0 + t1) / 2;
        ((this->value(m) < 0) == rising ? t0 : t1) = m;
      }
      return (t0 + t1) / 2;
    }
    if (half < 1e-20 * finest_) return middle;
    if (const auto t = search(t0, middle)) return t;
    return search(middle, t1);
  }

  Kernel kernel_;
  std::vector<Line> lines_;
  Quad magnitude_ = 0, finest_ = 0, first_ = 0, last_ = 0;
};

}  // namespace pbrt::metaballs::test
