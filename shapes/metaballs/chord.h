#pragma once
// The field along a piece of a ray, in float or in double lanes.
//
// Every number is relative to the middle of the piece, so that none is larger than the place in
// question (the power basis in the ray's own t loses all digits a few supports away from its
// origin). Along the ray an atom's q = r^2 / h^2 is a quadratic in the distance s, so the field is
// a polynomial of degree 6 but for atoms whose support ends within the piece, and for kernels that
// are none. Both go into the margin, which shrinks at least with the square of the piece.

#include "core/base/segment.h"
#include "shapes/metaballs/atom_lanes.h"
#include "shapes/metaballs/bernstein.h"

namespace pbrt::metaballs {
inline namespace PBRT_LANES {

template <class K, class V>
class Chord {
 public:
  using T = Lane<V>;

  // `near`: a place near the piece; in float lanes, one that has float coordinates.
  Chord(std::span<const Atom> atoms, AtomList list, const Segment& piece,
        const glm::vec<3, T>& near);

  // The field over [s0, s1]: x = 0 is s0 and x = 1 is s1.
  Bernstein over(T s0, T s1) const;

 private:
  static constexpr T kEpsilon = std::numeric_limits<T>::epsilon();
  static constexpr std::size_t kStored = 32;  // groups kept; of more, the lines are made anew

  // Atoms as the ray sees them: q(s) = (s - x)^2 / h^2 + r0.
  struct Lines {
    V x, r0, inverse2, weight;
    V error;  // bound on the error of q, where q < 2
  };
  // Polynomials in the quadratic b that is q (or 1 - q), with weights, and the margin.
  struct Sum {
    V cubic[7] = {}, quadratic[5] = {}, linear[3] = {}, constant = {};
    V lo = {}, hi = {};
    V rounding = {};   // sum of |weight| |dK/dq| error
    V magnitude = {};  // sum of |weight| K
  };

  Lines lines(std::size_t group) const;
  // Inlined, so that the sums stay in registers.
  [[gnu::always_inline]] static void add(const Lines& l, T s0, T s1, Sum& sum);
  [[gnu::always_inline]] static void addCubic(V w, V b0, V b1, V b2, Sum& sum);
  [[gnu::always_inline]] static void addQuadratic(V w, V b0, V b1, V b2, Sum& sum);

  std::span<const Atom> atoms_;
  AtomList list_;
  glm::vec<3, T> near_, o_, u_;
  T half_, error_, reach_;
  std::size_t groups_ = 0;
  Lines stored_[kStored];
};

template <class K, class V>
Chord<K, V>::Chord(std::span<const Atom> atoms, AtomList list, const Segment& piece,
                   const glm::vec<3, T>& near)
    : atoms_(atoms),
      list_(list),
      near_(near),
      o_(piece.o - DVec3(near)),
      u_(piece.u),
      half_(static_cast<T>(piece.half)),
      error_(static_cast<T>(piece.error)),
      groups_((list.size() + kLanes - 1) / kLanes) {
  reach_ = std::abs(o_.x) + std::abs(o_.y) + std::abs(o_.z) + half_;
  for (std::size_t i = 0; i < std::min(groups_, kStored); ++i) stored_[i] = lines(i);
}

template <class K, class V>
typename Chord<K, V>::Lines Chord<K, V>::lines(std::size_t group) const {
  const AtomLanes<V> a(atoms_, list_, group * kLanes, near_);
  const V vx = a.x - o_.x, vy = a.y - o_.y, vz = a.z - o_.z;
  const V x = vx * u_.x + vy * u_.y + vz * u_.z;
  const V ax = vx - x * u_.x, ay = vy - x * u_.y, az = vz - x * u_.z;  // |v|^2 - x^2 would cancel
  const V inverse2 = a.inverse * a.inverse;
  // x, the components of `a` and s are off by less than 8 epsilon of |v| + |o - near| + s (u has
  // unit length to within 2 epsilon), and o by error_. Moving a point at distance r < 1.5 h by d
  // moves q by (2 r d + d^2) / h^2. The rest is the rounding of q itself.
  const V reach = abs(vx) + abs(vy) + abs(vz) + reach_;
  const V d = (error_ + 16 * kEpsilon * reach) * a.inverse;
  return {x, (ax * ax + ay * ay + az * az) * inverse2, inverse2, a.weight,
          (3 + d) * d + 32 * kEpsilon};
}

// The product of three quadratics b, times 1, 6, 15, 20, 15, 6, 1 over common factors; see over().
template <class K, class V>
inline void Chord<K, V>::addCubic(V w, V b0, V b1, V b2, Sum& sum) {
  const V w0 = w * b0, w1 = w * b1, w2 = w * b2;
  const V s0 = b0 * b0, s1 = b1 * b1, s2 = b2 * b2;
  sum.cubic[0] += s0 * w0;
  sum.cubic[1] += s0 * w1;
  sum.cubic[2] += s0 * w2 + 4 * s1 * w0;
  sum.cubic[3] += (3 * b0 * b2 + 2 * s1) * w1;
  sum.cubic[4] += s2 * w0 + 4 * s1 * w2;
  sum.cubic[5] += s2 * w1;
  sum.cubic[6] += s2 * w2;
}

template <class K, class V>
inline void Chord<K, V>::addQuadratic(V w, V b0, V b1, V b2, Sum& sum) {
  const V w0 = w * b0, w1 = w * b1, w2 = w * b2;
  sum.quadratic[0] += b0 * w0;
  sum.quadratic[1] += b0 * w1;
  sum.quadratic[2] += b0 * w2 + 2 * b1 * w1;
  sum.quadratic[3] += b1 * w2;
  sum.quadratic[4] += b2 * w2;
}

// An atom whose support ends within [s0, s1] counts as the kernel gone on beyond its end, or as
// nothing, whichever is less wrong.
template <class K, class V>
inline void Chord<K, V>::add(const Lines& l, T s0, T s1, Sum& sum) {
  const V a = s0 - l.x, b = s1 - l.x;
  const V near = positivePart(max(a, -b));
  const V q0 = l.r0 + l.inverse2 * (a * a), q1 = l.r0 + l.inverse2 * (a * b),
          q2 = l.r0 + l.inverse2 * (b * b);
  const V least = min(q0, min(q1, q2)), most = max(q0, q2);  // q1 is no value of q
  const V within = 1 - (l.r0 + l.inverse2 * (near * near)) + l.error, beyond = most - 1 + l.error;
  const auto in = !(beyond >= within);  // so that what is no number shows
  const V w = in ? l.weight : V{}, size = abs(w);
  V wrong;
  if constexpr (requires { K::kExponent; }) {
    constexpr int n = K::kExponent;
    const V b0 = in ? 1 - q0 : V{}, b1 = in ? 1 - q1 : V{}, b2 = in ? 1 - q2 : V{};
    if constexpr (n == 3)
      addCubic(w, b0, b1, b2, sum);
    else
      addQuadratic(w, b0, b1, b2, sum);
    const V top = in ? max(1 - least, beyond) : V{};
    sum.rounding += size * l.error * (n * power<n - 1>(top));
    sum.magnitude += size * power<n>(top);
    const V end = power<n>(positivePart(in ? beyond : within));
    wrong = n % 2 == 0 ? (in ? -end : end) : end;
  } else {
    const V middle = in ? static_cast<T>(0.5) * (least + most) : V{};
    const V d0 = in ? q0 - middle : V{}, d1 = in ? q1 - middle : V{}, d2 = in ? q2 - middle : V{};
    const auto k = K::taylor(middle);
    addCubic(w * k.third, d0, d1, d2, sum);
    addQuadratic(w * k.second, d0, d1, d2, sum);
    sum.linear[0] += w * k.slope * d0;
    sum.linear[1] += w * k.slope * d1;
    sum.linear[2] += w * k.slope * d2;
    sum.constant += w * k.value;
    const V from = in ? least - l.error : V{};
    const V bend = K::fourth(from), d = max(abs(d0), max(abs(d1), abs(d2))) + l.error;
    const V remainder = size * bend * (d * d * d * d) * static_cast<T>(1.001 / 24);
    sum.lo -= remainder;
    sum.hi += remainder;
    sum.rounding += size * l.error * -K::taylor(from).slope;
    sum.magnitude += size * K::taylor(from).value + size * static_cast<T>(K::kEnd);
    const V end = 1 + (in ? positivePart(beyond) : V{});
    wrong = in ? -K::taylor(end).value : K::value(1 - positivePart(within));
    wrong = in ? positivePart(wrong) : wrong;
  }
  wrong *= l.weight;
  sum.lo += min(wrong, V{});
  sum.hi += max(wrong, V{});
}

template <class K, class V>
Bernstein Chord<K, V>::over(T s0, T s1) const {
  Sum sum;
  for (std::size_t i = 0; i < groups_; ++i) add(i < kStored ? stored_[i] : lines(i), s0, s1, sum);

  // The ordinates of a product of Bernstein polynomials, and of one raised to a higher degree, are
  // sums of products weighted by binomials (Farouki and Rajan 1988, eqs. 44 and 27).
  Bernstein f;
  f.c.fill(-1);
  // The last four lanes: margins and magnitudes.
  const V rest = sums(sum.constant, sum.linear[0], sum.linear[1], sum.linear[2], sum.lo, sum.hi,
                      sum.rounding, sum.magnitude);
  if constexpr (K::kCubic) {
    const V e = sums(sum.cubic[0], sum.cubic[1], sum.cubic[2], sum.cubic[3], sum.cubic[4],
                     sum.cubic[5], sum.cubic[6], V{});
    constexpr double share[7] = {1, 1, 0.2, 0.2, 0.2, 1, 1};
    for (int i = 0; i < 7; ++i) f.c[i] += share[i] * static_cast<double>(e[i]);
  }
  if constexpr (K::kQuadratic) {
    const V sum4 = sums(sum.quadratic[0], sum.quadratic[1], sum.quadratic[2], sum.quadratic[3],
                        sum.quadratic[4], V{}, V{}, V{});
    double e[5];
    for (int i = 0; i < 5; ++i) e[i] = sum4[i];
    e[2] /= 3;
    f.c[0] += e[0];
    f.c[1] += (e[0] + 2 * e[1]) / 3;
    f.c[2] += (e[0] + 8 * e[1] + 6 * e[2]) / 15;
    f.c[3] += (e[1] + 3 * e[2] + e[3]) / 5;
    f.c[4] += (6 * e[2] + 8 * e[3] + e[4]) / 15;
    f.c[5] += (2 * e[3] + e[4]) / 3;
    f.c[6] += e[4];
  }
  if constexpr (K::kLinear) {
    const double k = rest[0], d[3] = {rest[1], rest[2], rest[3]};
    f.c[0] += k + d[0];
    f.c[1] += k + (2 * d[0] + d[1]) / 3;
    f.c[2] += k + (6 * d[0] + 8 * d[1] + d[2]) / 15;
    f.c[3] += k + (d[0] + 3 * d[1] + d[2]) / 5;
    f.c[4] += k + (d[0] + 8 * d[1] + 6 * d[2]) / 15;
    f.c[5] += k + (d[1] + 2 * d[2]) / 3;
    f.c[6] += k + d[2];
  }
  // A sum of n terms in eight lanes loses less than (n / 8 + 8) epsilon of its magnitude; an
  // ordinate is the sum of few products; what follows is in double.
  const double terms = static_cast<double>(groups_) + 16 + 3 * K::kRounding;
  double largest = 1;
  for (const double c : f.c) largest = std::max(largest, std::abs(c));
  const double rounding = 1.01 * static_cast<double>(rest[6]) +
                          terms * kEpsilon * static_cast<double>(rest[7]) +
                          64 * std::numeric_limits<double>::epsilon() * largest;
  f.rounding = rounding;
  f.lo = static_cast<double>(rest[4]) * (1 + 64 * kEpsilon) - rounding;
  f.hi = static_cast<double>(rest[5]) * (1 + 64 * kEpsilon) + rounding;
  return f;
}

}  // namespace PBRT_LANES
}  // namespace pbrt::metaballs
