#pragma once
// The first crossing of a ray and metaballs, proven: written apart from what it judges, over all
// atoms that the ray comes near, with no cells. The ray's own t is bisected from the front; a piece
// is dropped, or its root called the only one, by proof alone. Ranges of the field and of its slope
// are doubles with bounds on their rounding; the field at a point is a double where that bound is
// far below its value, and a 113-bit float where it is not.

#include <optional>

#include "tests/shapes/metaballs/blocks.h"
#include "tests/shapes/metaballs/quad.h"

namespace pbrt::metaballs::test {

// A crossing, or (`touch`) a place where even 113 bits do not tell whether there is one.
struct Root {
  Quad t = 0;
  bool touch = false;

  operator Quad() const { return t; }
};

class Oracle {
 public:
  Oracle(const Field& field, const ObjectRay& ray) : Oracle(Blocks(field), ray) {}
  Oracle(const Blocks& blocks, const ObjectRay& ray);

  // The first t of [from, to] at which f = level, to 1e-25 of the smallest support there. None:
  // certainly none. A touch: neither proven nor excluded within 1e-20 of that support.
  std::optional<Root> first(Quad from, Quad to, double level = 0);
  std::optional<Root> first() { return first(ray_.tMin, ray_.tMax); }

  Quad value(Quad t) const { return exactly(t, all()).f; }
  DVec3 gradient(double t) const;
  double slope(double t) const { return slope(t, all()); }  // df/dt
  // By how much the terms of the field, each by itself, differ between two points within `distance`
  // of the one at t; in all.
  double swing(double t, double distance) const;
  // Of the atoms whose supports hold the point at t: how many, sum of |weight|, smallest radius.
  struct Scale {
    int atoms = 0;
    double weight = 0, radius = std::numeric_limits<double>::infinity();
  };
  Scale scale(double t) const;

 private:
  // An atom along the ray: q = rho + scale (t - closest)^2, to within qError where q < 1.
  struct Line {
    double closest, rho, scale, weight;
    double tError, qError;  // bounds on the errors of t - closest and q, t rounded to double
    double enter, exit;     // outside of them q >= 1
    const Atom* atom;
  };
  struct Ranges {
    Range value, slope;
  };
  struct Value {
    Quad f = 0, error = 0;
    int sign() const { return f > error ? 1 : f < -error ? -1 : 0; }
  };
  using List = std::span<const std::uint32_t>;

  List all() const { return List(lists_).first(lines_.size()); }
  template <class Number>
  std::pair<Number, Number> kernel(Number q) const;
  Ranges over(double t0, double t1, List list) const;
  Value value(Quad t, List list) const;
  Value exactly(Quad t, List list) const;
  double slope(double t, List list) const;
  std::optional<Root> search(Quad t0, Quad t1, std::size_t first, std::size_t count);
  Quad refine(Quad t0, Quad t1, bool rising, double enough, List list) const;

  Kernel kernel_;
  ObjectRay ray_;
  std::vector<Line> lines_;
  // Stack of the numbers of the lines that reach the piece of the ray under search; all at first.
  std::vector<std::uint32_t> lists_;
  double speed_;
  double base_ = -1;  // of the field: - 1 - level
};

// K and K' at q >= 0.
template <class Number>
std::pair<Number, Number> Oracle::kernel(Number q) const {
  if (q >= 1) return {0, 0};
  const Number a = 1 - q;
  if (kernel_ == Kernel::blob) return {a * a, -2 * a};
  if (kernel_ != Kernel::gaussian) return {a * a * a, -3 * a * a};
  using std::exp, test::exp;
  static const Number end = exp(Number(-4));
  const Number e = exp(-4 * q);
  return {e - end, -4 * e};
}

// Errors, in u = 2^-53: v is off by u |v| in each component, v . d / |d| by 8 u |v|, the part of v
// across the ray by 16 u |v|, and t, rounded to double, by u |t d| <= u (|v| + 2 h) where it
// matters: in all, the distance from the centre by less than e = 32 u (|v| + h). Where that
// distance is at most 2 h, q is off by (4 h e + e^2) / h^2 and by rounding of its own, 64 u. Where
// it is more, K = 0; q comes out >= 1 or, if e > h, qError is.
inline Oracle::Oracle(const Blocks& blocks, const ObjectRay& ray)
    : kernel_(blocks.field().kernel()), ray_(ray), speed_(glm::length(ray.d)) {
  const double dd = lengthSquared(ray.d);
  blocks.eachNear(ray, [&](const Atom& atom) {
    const double h = atom.radius;
    const DVec3 v = DPoint3(atom.centre) - ray.o;
    Line l;
    l.closest = glm::dot(v, ray.d) / dd;
    l.rho = lengthSquared(v - l.closest * ray.d) / sqr(h);
    l.scale = dd / sqr(h);
    l.weight = atom.weight;
    const double e = 16 * kEpsilon * (std::abs(v.x) + std::abs(v.y) + std::abs(v.z) + h);
    l.tError = e / speed_ * (1 + 8 * kEpsilon);
    l.qError = (4 + e / h) * e / h + 32 * kEpsilon;
    const double chord = 1 - l.rho + l.qError;
    if (chord <= 0) return;
    const double reach = (1 + 8 * kEpsilon) * std::sqrt(chord / l.scale) + l.tError;
    l.enter = l.closest - reach;
    l.exit = l.closest + reach;
    l.atom = &atom;
    if (l.exit < ray.tMin || l.enter > ray.tMax) return;
    lists_.push_back(static_cast<std::uint32_t>(lines_.size()));
    lines_.push_back(l);
  });
}

inline std::optional<Root> Oracle::first(Quad from, Quad to, double level) {
  base_ = -1 - level;
  Quad t0 = to, t1 = from;
  for (const Line& l : lines_) {
    t0 = std::min<Quad>(t0, l.enter);
    t1 = std::max<Quad>(t1, l.exit);
  }
  t0 = std::max(t0, from);
  t1 = std::min(t1, to);
  if (!(t0 < t1)) return {};
  const auto root = search(t0, t1, 0, lines_.size());
  base_ = -1;
  return root;
}

// Rounding of a sum of n terms: less than n epsilon of the sum of their absolute values.
inline Oracle::Ranges Oracle::over(double t0, double t1, List list) const {
  Ranges r{{base_, base_}, {0, 0}};
  double magnitude = std::abs(base_), slopeMagnitude = 0;
  for (const std::uint32_t j : list) {
    const Line& l = lines_[j];
    const double a = t0 - l.closest - l.tError, b = t1 - l.closest + l.tError;
    const double near = std::max(0.0, std::max(a, -b)), far = std::max(-a, b);
    const double q0 = l.rho + l.scale * near * near - l.qError;
    const double q1 = l.rho + l.scale * far * far + l.qError;
    const auto [k0, d0] = kernel(std::max(0.0, q0));
    const auto [k1, d1] = kernel(q1);
    const double f0 = l.weight * k0, f1 = l.weight * k1;
    r.value.lo += std::min(f0, f1);
    r.value.hi += std::max(f0, f1);
    magnitude += std::abs(l.weight);
    // df/dt = 2 w scale K'(q) (t - closest), K' in [d0, d1] as K is convex.
    const double c = 2 * l.weight * l.scale;
    const auto [least, most] = std::minmax({c * d0 * a, c * d0 * b, c * d1 * a, c * d1 * b});
    r.slope.lo += least;
    r.slope.hi += most;
    slopeMagnitude += std::abs(c * d0) * far;
  }
  const double rounding = (static_cast<double>(list.size()) + 16) * kEpsilon;
  r.value.lo -= rounding * magnitude;
  r.value.hi += rounding * magnitude;
  r.slope.lo -= rounding * slopeMagnitude;
  r.slope.hi += rounding * slopeMagnitude;
  return r;
}

// As double if that settles it to 2^-10; |K'| <= 4 turns errors of q into errors of K.
inline Oracle::Value Oracle::value(Quad t, List list) const {
  const auto rounded = static_cast<double>(t);
  const double rounding = (static_cast<double>(list.size()) + 16) * kEpsilon;
  double f = base_, error = rounding * std::abs(base_);
  for (const std::uint32_t j : list) {
    const Line& l = lines_[j];
    f += l.weight * kernel(l.rho + l.scale * sqr(rounded - l.closest)).first;
    error += std::abs(l.weight) * (4 * l.qError + rounding);
  }
  if (std::abs(f) > 1024 * error) return {f, error};
  return exactly(t, list);
}

// The bound of the double sum scaled from 53 bits to 113; for exp, from rounding >= 2^-48 to 1e-28.
inline Oracle::Value Oracle::exactly(Quad t, List list) const {
  Quad p[3];
  for (int i = 0; i < 3; ++i) p[i] = ray_.o[i] + t * ray_.d[i];
  const double rounding = (static_cast<double>(list.size()) + 16) * kEpsilon;
  Quad f = base_;
  double error = rounding * std::abs(base_);
  for (const std::uint32_t j : list) {
    const Line& l = lines_[j];
    Quad rr = 0;
    for (int i = 0; i < 3; ++i) {
      const Quad v = p[i] - l.atom->centre[i];
      rr += v * v;
    }
    f += l.weight * kernel(rr / sqr(static_cast<double>(l.atom->radius))).first;
    error += std::abs(l.weight) * (4 * l.qError + rounding);
  }
  return {f, (kernel_ == Kernel::gaussian ? 0x1p-44 : 0x1p-60) * error};
}

inline std::optional<Root> Oracle::search(Quad t0, Quad t1, std::size_t first, std::size_t count) {
  const auto a = static_cast<double>(t0), b = static_cast<double>(t1);
  const std::size_t mine = lists_.size();
  double smallest = kInfinity;
  for (std::size_t i = first; i < first + count; ++i) {
    const std::uint32_t j = lists_[i];
    if (lines_[j].exit < a || lines_[j].enter > b) continue;
    lists_.push_back(j);
    smallest = std::min(smallest, static_cast<double>(lines_[j].atom->radius));
  }
  const std::size_t number = lists_.size() - mine;
  const auto answer = [&]() -> std::optional<Root> {
    const List list = List(lists_).subspan(mine);
    const auto [range, slope] = over(a, b, list);
    if (!range.contains(0)) return {};
    // |f - f(middle)| <= max |f'| half.
    const Quad middle = (t0 + t1) / 2, half = (t1 - t0) / 2;
    const Value f = value(middle, list);
    if (abs(f.f) - f.error > std::max(-slope.lo, slope.hi) * half) return {};
    const bool rising = slope.lo > 0;
    if (rising || slope.hi < 0) {
      const int before = value(t0, list).sign(), after = value(t1, list).sign();
      if (before == 0 || after == 0) return Root{before == 0 ? t0 : t1, true};
      if (before == after) return {};
      return Root{refine(t0, t1, rising, 1e-26 * smallest / speed_, list), false};
    }
    if (half * speed_ < 1e-20 * smallest)
      return Root{middle, value(t0, list).sign() * value(t1, list).sign() >= 0};
    if (const auto t = search(t0, middle, mine, number)) return t;
    return search(middle, t1, mine, number);
  }();
  lists_.resize(mine);
  return answer;
}

// The only zero in [t0, t1] by Newton's method, until a step is `enough`; kept inside the bracket,
// and bisected where it does not halve its steps.
inline Quad Oracle::refine(Quad t0, Quad t1, bool rising, double enough, List list) const {
  Quad t = (t0 + t1) / 2, step = t1 - t0;
  while (step > enough) {
    const Value f = value(t, list);
    if (f.sign() == 0) break;
    ((f.sign() < 0) == rising ? t0 : t1) = t;
    Quad next = t - f.f / slope(static_cast<double>(t), list);
    if (!(next > t0 && next < t1 && abs(next - t) <= step / 2)) next = (t0 + t1) / 2;
    step = abs(next - t);
    t = next;
  }
  return t;
}

inline double Oracle::slope(double t, List list) const {
  double sum = 0;
  for (const std::uint32_t j : list) {
    const Line& l = lines_[j];
    const double x = t - l.closest;
    sum += 2 * l.weight * l.scale * kernel(l.rho + l.scale * sqr(x)).second * x;
  }
  return sum;
}

inline DVec3 Oracle::gradient(double t) const {
  DVec3 g(0);
  for (const Line& l : lines_) {
    const DVec3 v = ray_.at(t) - DPoint3(l.atom->centre);
    const double inverse = 1 / sqr(static_cast<double>(l.atom->radius));
    g += 2 * l.weight * inverse * kernel(lengthSquared(v) * inverse).second * v;
  }
  return g;
}

inline double Oracle::swing(double t, double distance) const {
  double sum = 0;
  for (const Line& l : lines_) {
    const double r = std::sqrt(l.rho + l.scale * sqr(t - l.closest));
    const double d = distance / l.atom->radius;
    sum +=
        std::abs(l.weight) * (kernel(sqr(std::max(0.0, r - d))).first - kernel(sqr(r + d)).first);
  }
  return sum;
}

inline Oracle::Scale Oracle::scale(double t) const {
  Scale s;
  for (const Line& l : lines_) {
    if (t < l.enter || t > l.exit) continue;
    ++s.atoms;
    s.weight += std::abs(l.weight);
    s.radius = std::min(s.radius, static_cast<double>(l.atom->radius));
  }
  return s;
}

}  // namespace pbrt::metaballs::test
