#include "core/plugin/implicit_roots.h"

#include <array>

namespace pbrt {
namespace {

struct Part {
  double a = 0, b = 0;

  double middle() const { return 0.5 * (a + b); }
};

class Search {
 public:
  Search(const ImplicitField& field, const Segment& piece, bool any)
      : field_(field),
        piece_(piece),
        any_(any),
        shortest_(0x1p-46 * (2 * piece.half) + piece.error),
        enough_(std::max(0x1p-48 * (2 * piece.half), piece.error)),
        startsUntil_(piece.starts ? -piece.half : -kInfinity) {
    later_[0] = {-piece.half, piece.half};
  }

  std::optional<double> first() {
    while (pending_ > 0) {
      const Part part = later_[--pending_];
      if (const auto s = looks_ > 0 ? within(part) : bySigns(part)) return s;
    }
    return {};
  }

 private:
  std::optional<double> within(Part p);
  std::optional<double> bySigns(Part p) const;
  std::optional<double> touch(const Part& p);
  double refined(Part p, bool rising) const;

  LineRange over(const Range& s) {
    --looks_;
    return field_.along(piece_.o, piece_.u, s, piece_.error);
  }
  FieldPoint at(double s) const { return field_.at(piece_.o + s * piece_.u); }
  void push(const Part& p) { later_[pending_++] = p; }

  const ImplicitField& field_;
  const Segment& piece_;
  bool any_;
  double shortest_;  // a part as short as this is a touch
  double enough_;    // how well a crossing is to be known
  double
      startsUntil_;  // from its start to here the ray is on the surface, for all that ranges tell
  int looks_ = kMostLooks;
  // Parts still to be searched, the first on top. Parts are halved, and there is one for each
  // halving: 47 before they are too short.
  std::array<Part, 64> later_;
  int pending_ = 1;
};

// From the middle m, where f is in F, to a zero at s the slope D must take f: f(m) = D' (m - s) for
// some D' of D (the mean value theorem). Where the slope has one sign, the only zero is in m - F /
// D (interval Newton: Moore 1966, ch. 7), and if this lies within the part, there is one. Where
// not, but F excludes zero, there is none nearer to m than |F| over the steepest slope towards
// zero.
std::optional<double> Search::within(Part p) {
  while (looks_ > 0) {
    const LineRange r = over({p.a, p.b});
    if (!r.value.contains(0)) return {};
    const double m = p.middle();
    if (!r.slope.bounded()) {
      if (p.b - p.a <= shortest_) return r.value.bounded() ? touch(p) : std::nullopt;
      push({m, p.b});
      p.b = m;
      continue;
    }
    const Range f = over(m).value;
    if (f.empty()) {  // no value there: nothing holds from there
      if (p.b - p.a <= shortest_) return {};
      push({m, p.b});
      p.b = m;
      continue;
    }
    const Range reach = r.slope * (Range(p.a, p.b) - m);
    if (p.b - p.a <= shortest_ || (reach.width() <= 3 * f.width() && (f + reach).contains(0)))
      return touch(p);
    const double before = p.b - p.a;
    if (!r.slope.contains(0)) {
      const Range zero = m - f / r.slope;
      if (zero.lo > p.a && zero.hi < p.b)
        return any_ ? zero.lo : refined({zero.lo, zero.hi}, r.slope.lo > 0);
      p = {std::max(p.a, zero.lo), std::min(p.b, zero.hi)};
      if (!(p.a <= p.b)) return {};
    } else if (!f.contains(0)) {
      const Range slope = f.lo > 0 ? r.slope : -r.slope;  // as if f were above zero at m
      const double least = std::min(std::abs(f.lo), std::abs(f.hi));
      const double left = slope.hi > 0 ? (m - Range(least) / slope.hi).hi : p.a;
      const double right = slope.lo < 0 ? (m + Range(least) / -slope.lo).lo : p.b;
      const bool hasLeft = left > p.a, hasRight = right < p.b;
      if (hasLeft && hasRight) push({right, p.b});
      if (hasLeft)
        p.b = left;
      else if (hasRight)
        p.a = right;
      else
        return {};
    }
    if (p.b - p.a > 0.5 * before) {
      push({p.middle(), p.b});
      p.b = p.middle();
    }
  }
  return bySigns(p);
}

std::optional<double> Search::touch(const Part& p) {
  if (p.a > startsUntil_) return p.middle();
  startsUntil_ = p.b + shortest_;
  return {};
}

std::optional<double> Search::bySigns(Part p) const {
  const double a = at(p.a).value, b = at(p.b).value;
  if (!((a < 0 && b > 0) || (a > 0 && b < 0)) || p.a <= startsUntil_) return {};
  return refined(p, a < 0);
}

// Newton's method, by bisection where it leaves the part.
double Search::refined(Part p, bool rising) const {
  double s = p.middle();
  for (int i = 0; i < 100 && p.b - p.a > enough_; ++i) {
    const FieldPoint f = at(s);
    const double step = -f.value / glm::dot(f.gradient, piece_.u);
    if (std::abs(step) <= enough_) return s + step;
    ((f.value < 0) == rising ? p.a : p.b) = s;
    s = s + step > p.a && s + step < p.b ? s + step : p.middle();
  }
  return s;
}

}  // namespace

std::optional<double> firstZero(const ImplicitField& field, const Segment& piece, bool any) {
  if (piece.half < 0) return {};
  return Search(field, piece, any).first();
}

}  // namespace pbrt
