#include "shapes/metaballs/roots.h"

#include <array>

namespace pbrt::metaballs {
namespace {

// The part [t0, t1] of the ray inside the box; empty (t0 > t1) if there is none. Rounding may lose
// a sliver at a face: cells overlap by more than that.
struct Clip {
  double t0 = 0, t1 = -1;
};

Clip clip(const ObjectRay& ray, const Bounds3& box) {
  Clip c{ray.tMin, ray.tMax};
  for (int i = 0; i < 3; ++i) {
    const double lo = box.lo[i] - ray.o[i], hi = box.hi[i] - ray.o[i];
    if (ray.d[i] == 0) {
      if (lo > 0 || hi < 0) return {};
      continue;
    }
    const double inverse = 1 / ray.d[i];
    const double a = lo * inverse, b = hi * inverse;
    c.t0 = std::max(c.t0, std::min(a, b));
    c.t1 = std::min(c.t1, std::max(a, b));
  }
  return c;
}

// The field along the part of a ray that lies in a cell. The parameter s is the distance from the
// middle of that part, so that no number is larger than the place in question (the power basis in
// the ray's own t loses all digits a few supports away from its origin).
//
// Along the ray an atom's q is ((s - x)^2 + rho^2) / h^2, x where the ray comes closest and rho how
// close. It falls before x and rises after, hence its exact range over an interval comes from the
// interval's nearest and farthest point; the kernel's monotonicity and convexity give the ranges of
// f and of f' = sum 2 w / h^2 K'(q) (s - x).
template <class K>
class Chord {
 public:
  Chord(const Field& field, const Cell& cell, AtomList list, const ObjectRay& ray, Effort& effort);

  std::optional<double> first();
  bool crosses();

 private:
  // An atom as the ray sees it. Fields are left uninitialised: most of the array is never touched.
  struct Line {
    double x, rho2;   // closest approach
    double inverse2;  // 1 / h^2
    double weight;
    double error;   // bound on the error of s - x
    double qError;  // bound on the error of q, where q < 1
  };
  struct Bounds {
    Interval value, slope;
  };
  struct Point {
    double value = -1, slope = 0;
  };
  struct End {
    double s = 0;
    Interval f;
  };
  static constexpr int kStored = 160;  // atoms whose lines are kept; of more, they are made anew

  // Whether the atom reaches the chord; if so, `line` is set.
  bool reaches(const Atom& atom, Line& line) const;
  template <class F>
  void eachLine(F f) const;

  Bounds bounds(double s0, double s1);
  End end(double s);
  Point point(double s);

  std::optional<double> first(const End& a, const End& b, const Bounds& between);
  std::optional<double> polish(const End& a, const End& b, bool rising);
  std::optional<double> accept(double s) const;

  const std::vector<Atom>& atoms_;
  Effort& effort_;
  AtomList rest_;  // beyond those stored
  double tMin_, tMax_;
  double middle_ = 0;    // t at s = 0
  double speed_ = 0;     // |d|
  DPoint3 o_{};          // the point at s = 0
  DVec3 u_{};            // unit direction
  double half_ = -1;     // s in [-half, half]; negative: the ray misses the cell
  bool starts_ = false;  // the ray starts inside the cell
  double error_ = 0;     // bound on the distance of o + s u from the ray's true point
  double tolerance_ = 0;
  double sumError_ = 0;  // relative error of a sum over the atoms
  int stored_ = 0;
  std::array<Line, kStored> lines_;
};

template <class K>
Chord<K>::Chord(const Field& field, const Cell& cell, AtomList list, const ObjectRay& ray,
                Effort& effort)
    : atoms_(field.atoms()), effort_(effort), tMin_(ray.tMin), tMax_(ray.tMax) {
  const Clip c = clip(ray, cell.box);
  speed_ = glm::length(ray.d);
  if (!(c.t0 <= c.t1) || !(speed_ > 0 && speed_ < kInfinity)) return;
  middle_ = 0.5 * c.t0 + 0.5 * c.t1;
  o_ = ray.at(middle_);
  u_ = ray.d / speed_;
  half_ = 0.5 * (c.t1 - c.t0) * speed_;
  starts_ = c.t0 == ray.tMin;
  // o + t d is rounded twice in each coordinate, t once; a factor of two to spare.
  const DVec3 reach = glm::abs(ray.o) + std::abs(middle_) * glm::abs(ray.d);
  error_ = 4 * kEpsilon * (reach.x + reach.y + reach.z);
  tolerance_ = 0x1p-46 * (2 * half_) + error_;
  sumError_ = (static_cast<double>(list.size()) + 16) * kEpsilon;

  std::size_t i = 0;
  for (; i < list.size() && stored_ < kStored; ++i)
    if (reaches(atoms_[list[i]], lines_[stored_])) ++stored_;
  rest_ = list.subspan(i);
}

template <class K>
bool Chord<K>::reaches(const Atom& atom, Line& line) const {
  const DVec3 v = DPoint3(atom.centre) - o_;
  const double x = glm::dot(v, u_);
  const DVec3 across = v - x * u_;  // not |v|^2 - x^2, which cancels
  const double rho2 = glm::dot(across, across);
  const double inverse2 = sqr(atom.inverseRadius);
  // x, the components of `across` and s are off by less than 8 epsilon of |v| + s (u has unit
  // length to within 2 epsilon), and o by error_.
  const double reach = std::abs(v.x) + std::abs(v.y) + std::abs(v.z) + half_;
  const double error = error_ + 16 * kEpsilon * reach;
  // Moving a point at distance r <= h + error by `error` moves q by (2 r error + error^2) / h^2 at
  // most. The rest is the rounding of q itself and, as in field.cpp, of the gaussian.
  const double e = error * atom.inverseRadius;
  const double qError = 2 * e + 3 * e * e + 16 * kEpsilon;
  const double off = std::max(0.0, std::abs(x) - half_);
  if ((off * off + rho2) * inverse2 - qError >= 1) return false;
  line = {x, rho2, inverse2, atom.weight, error, qError};
  return true;
}

template <class K>
template <class F>
void Chord<K>::eachLine(F f) const {
  for (int i = 0; i < stored_; ++i) f(lines_[i]);
  Line line;
  for (const std::uint32_t j : rest_)
    if (reaches(atoms_[j], line)) f(line);
}

template <class K>
typename Chord<K>::Bounds Chord<K>::bounds(double s0, double s1) {
  ++effort_.intervals;
  Bounds sum{{-1, -1}, {0, 0}};
  double magnitude = 1, slopeMagnitude = 0;
  eachLine([&](const Line& l) {
    const double a = s0 - l.x, b = s1 - l.x;
    const double near = std::max(0.0, std::max(a, -b)), far = std::max(-a, b);
    const double q0 = (near * near + l.rho2) * l.inverse2 - l.qError;
    const double q1 = (far * far + l.rho2) * l.inverse2 + l.qError;
    const double most = l.weight * K::value(q0);
    addHull(sum.value, most, l.weight * K::value(q1));
    magnitude += std::abs(most);
    const double c = 2 * l.weight * l.inverse2;
    const double k0 = c * K::slope(q0), k1 = c * K::slope(q1);
    const double a1 = a - l.error, b1 = b + l.error;
    sum.slope.lo += std::min(std::min(k0 * a1, k0 * b1), std::min(k1 * a1, k1 * b1));
    sum.slope.hi += std::max(std::max(k0 * a1, k0 * b1), std::max(k1 * a1, k1 * b1));
    slopeMagnitude += std::abs(k0) * std::max(-a1, b1);
  });
  // The errors of q and s are in the ranges already; what is left is that of the sums.
  sum.value.lo -= sumError_ * magnitude;
  sum.value.hi += sumError_ * magnitude;
  sum.slope.lo -= sumError_ * slopeMagnitude;
  sum.slope.hi += sumError_ * slopeMagnitude;
  return sum;
}

template <class K>
typename Chord<K>::End Chord<K>::end(double s) {
  ++effort_.points;
  Interval sum{-1, -1};
  double magnitude = 1;
  eachLine([&](const Line& l) {
    const double q = (sqr(s - l.x) + l.rho2) * l.inverse2;
    const double most = l.weight * K::value(q - l.qError);
    addHull(sum, most, l.weight * K::value(q + l.qError));
    magnitude += std::abs(most);
  });
  return {s, {sum.lo - sumError_ * magnitude, sum.hi + sumError_ * magnitude}};
}

template <class K>
typename Chord<K>::Point Chord<K>::point(double s) {
  ++effort_.points;
  Point sum;
  eachLine([&](const Line& l) {
    const double a = s - l.x;
    const double q = (a * a + l.rho2) * l.inverse2;
    sum.value += l.weight * K::value(q);
    sum.slope += 2 * l.weight * l.inverse2 * K::slope(q) * a;
  });
  return sum;
}

// Whether a function whose values at the ends of an interval of width w lie in fa and fb, and whose
// slope lies in `slope` (which holds zero), provably keeps off zero. If both values are negative,
// f(x) <= fa + S x and f(x) <= fb + R (w - x) with S, -R the largest and smallest slope; the lines
// meet at the height (R fa + S fb + S R w) / (S + R), above which f never is (Piyavskii 1972).
// The bound's error shrinks with w^2: that is what ends the search beside a near touch quickly.
bool keepsOff(const Interval& fa, const Interval& fb, const Interval& slope, double w) {
  const bool below = fa.hi < 0 && fb.hi<0, above = fa.lo> 0 && fb.lo > 0;
  if (!below && !above) return false;
  const double a = below ? -fa.hi : fa.lo, b = below ? -fb.hi : fb.lo;  // how far off zero
  const double towardsFromA = std::max(0.0, below ? slope.hi : -slope.lo);
  const double towardsFromB = std::max(0.0, below ? -slope.lo : slope.hi);
  const double off = towardsFromB * a + towardsFromA * b;
  return off * (1 - 8 * kEpsilon) >= towardsFromA * towardsFromB * w && off > 0;
}

template <class K>
std::optional<double> Chord<K>::first(const End& a, const End& b, const Bounds& between) {
  const auto& [value, slope] = between;
  if (!value.contains(0)) return {};
  const bool rising = slope.lo > 0;
  if (rising || slope.hi < 0) {
    // At most one zero: is it behind a or beyond b? One at the ray's start is behind.
    const bool behind =
        (rising ? a.f.lo > 0 : a.f.hi < 0) || (starts_ && a.s == -half_ && a.f.contains(0));
    const bool beyond = rising ? b.f.hi < 0 : b.f.lo > 0;
    return behind || beyond ? std::nullopt : polish(a, b, rising);
  }
  if (keepsOff(a.f, b.f, slope, b.s - a.s)) return {};
  const double middle = 0.5 * (a.s + b.s);
  if (b.s - a.s <= tolerance_) return accept(middle);
  const End m = end(middle);
  if (const auto t = first(a, m, bounds(a.s, middle))) return t;
  return first(m, b, bounds(middle, b.s));
}

// Newton's method, kept inside the bracket; bisection where it does not halve its steps.
template <class K>
std::optional<double> Chord<K>::polish(const End& a, const End& b, bool rising) {
  double lo = a.s, hi = b.s, step = hi - lo;
  const double fa = a.f.lo + a.f.hi, fb = b.f.lo + b.f.hi;
  double s = fa != fb ? std::clamp(lo - fa * step / (fb - fa), lo, hi) : 0.5 * (lo + hi);
  for (int i = 0; i < 100 && step > 0x1p-4 * tolerance_; ++i) {
    const Point f = point(s);
    if (f.value == 0) break;
    ((f.value < 0) == rising ? lo : hi) = s;
    double next = s - f.value / f.slope;
    if (!(next > lo && next < hi && std::abs(next - s) <= 0.5 * step)) next = 0.5 * (lo + hi);
    step = std::abs(next - s);
    s = next;
  }
  return accept(s);
}

template <class K>
std::optional<double> Chord<K>::accept(double s) const {
  const double t = middle_ + s / speed_;
  return t > tMin_ && t <= tMax_ ? std::optional(t) : std::nullopt;
}

template <class K>
std::optional<double> Chord<K>::first() {
  if (half_ < 0) return {};
  const Bounds whole = bounds(-half_, half_);
  if (!whole.value.contains(0)) return {};  // most cells that a ray misses end here
  return first(end(-half_), end(half_), whole);
}

template <class K>
bool Chord<K>::crosses() {
  if (half_ < 0) return false;
  const Bounds whole = bounds(-half_, half_);
  if (!whole.value.contains(0)) return false;
  const End a = end(-half_), b = end(half_);
  if ((a.f.hi < 0 && b.f.lo > 0) || (a.f.lo > 0 && b.f.hi < 0)) return true;
  return first(a, b, whole).has_value();
}

}  // namespace

std::optional<double> firstCrossing(const Field& field, const Cell& cell, AtomList list,
                                    const ObjectRay& ray, Effort* effort) {
  Effort own;
  return withKernel(field.kernel(), [&]<class K>(K) {
    return Chord<K>(field, cell, list, ray, effort ? *effort : own).first();
  });
}

bool crosses(const Field& field, const Cell& cell, AtomList list, const ObjectRay& ray) {
  Effort own;
  return withKernel(field.kernel(),
                    [&]<class K>(K) { return Chord<K>(field, cell, list, ray, own).crosses(); });
}

}  // namespace pbrt::metaballs
