#pragma once
// Bounds of the field over the eight octants of a box.
//
// K is convex in q, and q = r^2 / h^2 is a quadratic with equal second derivatives on all axes.
// Hence K lies above any tangent in q and below its secant in q over an octant. Both are
// paraboloids in x, and so are their sums over all atoms, between which f must lie; a carving atom
// gives its tangent to the upper one.
//
// The tangent is the one at q(0) + |half|^2 / h^2, the mean of the q of two opposite corners: in
// the inside of a dense set the gradient is small and the corners decide, whence this proves
// octants inside that are a quarter larger than with the tangent at the centre.

#include "shapes/metaballs/loops.h"

namespace pbrt::metaballs {
inline namespace PBRT_LANES {

// Adds value + slope (q(x) - q(0)), where q(x) - q(0) = (2 v.x + |x|^2) / h^2 and k = slope / h^2.
inline void add(Paraboloid& p, Floats value, Floats k, const Floats* v) {
  p.a += value;
  const Floats twice = k + k;
  for (int i = 0; i < 3; ++i) p.b[i] += twice * v[i];
  p.g += k;
}

// The largest (sign = 1) or smallest (-1) of b x + g x^2 on one axis, |x| <= h, times `sign`.
inline Floats extreme(const Paraboloid& p, int axis, float sign, Floats h) {
  const Floats bend = sign * p.g, tilt = abs(p.b[axis]);
  const Floats x = bend < 0 ? min(h, tilt / max(-2 * bend, Floats{} + 1e-30F)) : h;
  return (tilt + bend * x) * x;
}

inline Floats squaredLength(const Floats* v) {
  return v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
}

// The largest (sign = 1) or smallest (-1) value over the octants, times `sign`.
inline Floats extreme(const Paraboloid& p, float sign, const Eight& o) {
  return sign * p.a + extreme(p, 0, sign, o.half[0]) + extreme(p, 1, sign, o.half[1]) +
         extreme(p, 2, sign, o.half[2]);
}

// Bound on the rounding of sums over a list whose terms add up to `magnitude` in size.
template <class K>
Floats slack(AtomList list, Floats magnitude) {
  const auto terms = static_cast<float>(list.size() + 64 + 2 * K::kRounding);
  return (magnitude * terms + 4) * std::numeric_limits<float>::epsilon();
}

template <class K>
bool allInside(std::span<const Atom> atoms, AtomList list, const Eight& o) {
  Paraboloid below;
  const Floats half2 = squaredLength(o.half);
  Floats slopes{};
  float inverse2 = 0;
  for (const std::uint32_t j : list) {
    const Atom& atom = atoms[j];
    inverse2 = max(inverse2, atom.inverse2);
    const Floats v[3] = {o.centre[0] - atom.centre.x, o.centre[1] - atom.centre.y,
                         o.centre[2] - atom.centre.z};
    const Floats shift = half2 * atom.inverse2;
    const Floats q = squaredLength(v) * atom.inverse2 + shift;
    const Floats slope = atom.lightWeight * K::slope(q);
    slopes -= slope;
    add(below, atom.lightWeight * K::value(q) - slope * shift, slope * atom.inverse2, v);
  }
  // |q(x) - q(0)| <= 2 |half| / h + |half|^2 / h^2 for atoms whose tangent is not zero.
  const Floats margin = slack<K>(list, below.a + slopes * (1 + 3 * half2 * inverse2));
  below.a -= 1;
  return bits(-extreme(below, -1, o) - margin > 0) == 0xFF;
}

// Without Tight, in the place of the secants is each atom's largest value by itself.
template <class K, bool Tight>
void bounds(std::span<const Atom> atoms, AtomList list, const Eight& o, std::uint8_t* masks,
            EightBounds& r) {
  constexpr float epsilon = std::numeric_limits<float>::epsilon();
  r = {};
  Floats magnitude{};
  const Floats half2 = squaredLength(o.half);
  for (std::size_t n = 0; n < list.size(); ++n) {
    const Atom& atom = atoms[list[n]];
    const float inverse2 = atom.inverse2, w = atom.lightWeight;
    Floats v[3], near[3], farthest{}, spread = half2;
    for (int i = 0; i < 3; ++i) {
      v[i] = o.centre[i] - (&atom.centre.x)[i];
      const Floats off = abs(v[i]);
      near[i] = positivePart(off - o.half[i]);
      spread += 2 * off * o.half[i];
      if (Tight) farthest += square(off + o.half[i]);
    }
    const Floats q = squaredLength(v) * inverse2;
    const Floats nearest = squaredLength(near) * inverse2 * (1 - 32 * epsilon) - 32 * epsilon;
    const unsigned mask = bits(nearest < 1);
    masks[n] = static_cast<std::uint8_t>(mask);
    if (!mask) continue;

    const Floats shift = half2 * inverse2, most = w * K::value(nearest);
    const Floats slope = w * K::slope(q + shift);
    magnitude += abs(most) + abs(slope) * spread * inverse2;
    Paraboloid &tangents = w > 0 ? r.below : r.above, &secants = w > 0 ? r.above : r.below;
    add(tangents, w * K::value(q + shift) - slope * shift, slope * inverse2, v);
    if (Tight) {
      farthest = farthest * inverse2 * (1 + 32 * epsilon) + 32 * epsilon;
      const Floats secant = (w * K::value(farthest) - most) / (farthest - nearest);
      add(secants, most + secant * (q - nearest), secant * inverse2, v);
    } else {
      secants.a += most;
    }
  }
  r.slack = slack<K>(list, magnitude);
  r.below.a -= 1;
  r.above.a -= 1;
  const auto inside = -extreme(r.below, -1, o) - r.slack > 0;
  const auto outside = extreme(r.above, 1, o) + r.slack < 0;
  r.undecided = bits(!(inside || outside));
}

}  // namespace PBRT_LANES
}  // namespace pbrt::metaballs
