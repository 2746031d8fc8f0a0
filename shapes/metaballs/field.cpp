#include "shapes/metaballs/field.h"

#include <algorithm>

#include "shapes/metaballs/loops.h"

namespace pbrt::metaballs {
namespace {

// The smallest interval that holds x and y, added to `sum`.
void addHull(Range& sum, double x, double y) {
  sum.lo += std::min(x, y);
  sum.hi += std::max(x, y);
}

// The range of each atom by itself, from its nearest and farthest point of the box.
//
// Rounding: near2 and far2 are off by less than 4 epsilon of themselves, q by less than 8; K loses
// less than kRounding epsilon of itself for a power. For the gaussian it is that of K + 2 exp(-b),
// and moving q by d changes K by more than d b exp(-b): widening q by 64 epsilon covers that too.
// A sum of n terms loses less than n epsilon of the sum of their absolute values.
template <class K>
FieldRange rangeOver(const DPoint3& lo, const DPoint3& hi, const std::vector<Atom>& atoms,
                     AtomList list) {
  constexpr double widened = 64 * kEpsilon;
  FieldRange range{{-1, -1}, {}};
  double magnitude = 1;
  DVec3 slopeMagnitude(0);
  for (const std::uint32_t j : list) {
    const Atom& atom = atoms[j];
    const DVec3 a = lo - DPoint3(atom.centre), b = hi - DPoint3(atom.centre);
    const DVec3 near = glm::max(DVec3(0), glm::max(a, -b)), far = glm::max(-a, b);
    const double inverse2 = 1 / (static_cast<double>(atom.radius) * atom.radius);
    const double q0 = glm::dot(near, near) * inverse2 * (1 - widened) - widened;
    const double q1 = glm::dot(far, far) * inverse2 * (1 + widened) + widened;
    if (q0 >= 1) continue;
    addHull(range.value, atom.weight * K::value(q0), atom.weight * K::value(q1));
    magnitude += std::abs(atom.weight) * K::value(q0);
    // df/dx = 2 w / h^2 K'(q) (x - a_x): K' in [k0, k1], the offset in [a, b].
    const double c = 2 * atom.weight * inverse2;
    const double k0 = c * K::slope(q0), k1 = c * K::slope(q1);
    for (int i = 0; i < 3; ++i) {
      range.gradient[i].lo += std::min({k0 * a[i], k0 * b[i], k1 * a[i], k1 * b[i]});
      range.gradient[i].hi += std::max({k0 * a[i], k0 * b[i], k1 * a[i], k1 * b[i]});
    }
    slopeMagnitude += std::abs(k0) * far;
  }
  const double error = (static_cast<double>(list.size()) + 2 * K::kRounding) * kEpsilon;
  range.value.lo -= error * magnitude;
  range.value.hi += error * magnitude;
  for (int i = 0; i < 3; ++i) {
    range.gradient[i].lo -= error * slopeMagnitude[i];
    range.gradient[i].hi += error * slopeMagnitude[i];
  }
  return range;
}

template <class K>
Range boundAs(const DPoint3& lo, const DPoint3& hi, const std::vector<Atom>& atoms, AtomList list) {
  const FieldRange box = rangeOver<K>(lo, hi, atoms, list);
  if (lo == hi || !box.value.contains(0)) return box.value;
  // The mean value form: |f(x) - f(c)| <= sum over the axes of max|df/dx_i| |x_i - c_i|. Where
  // atoms on opposite sides balance, this shrinks with the square of the box.
  const DPoint3 c = 0.5 * lo + 0.5 * hi;
  const Range centre = rangeOver<K>(c, c, atoms, list).value;
  const DVec3 steepest(box.gradient[0].magnitude(), box.gradient[1].magnitude(),
                       box.gradient[2].magnitude());
  const double swing = glm::dot(steepest, glm::max(hi - c, c - lo)) * (1 + 8 * kEpsilon);
  return {std::max(box.value.lo, centre.lo - swing), std::min(box.value.hi, centre.hi + swing)};
}

}  // namespace

Field::Field(Kernel kernel, std::vector<Atom> atoms)
    : kernel_(kernel),
      atoms_(std::move(atoms)),
      carves_(std::ranges::any_of(atoms_, [](const Atom& a) { return a.weight < 0; })),
      alike_(std::ranges::all_of(atoms_,
                                 [&](const Atom& a) { return a.radius == atoms_[0].radius; })) {}

float Field::smallestRadius(AtomList list) const {
  if (alike_) return atoms_.empty() ? kInfinity : atoms_[0].radius;
  float smallest = kInfinity;
  for (const std::uint32_t j : list) smallest = std::min(smallest, atoms_[j].radius);
  return smallest;
}

FieldRange Field::range(const DPoint3& lo, const DPoint3& hi, AtomList list) const {
  return withKernel(kernel_, [&]<class K>(K) { return rangeOver<K>(lo, hi, atoms_, list); });
}

Range Field::bound(const DPoint3& lo, const DPoint3& hi, AtomList list) const {
  return withKernel(kernel_, [&]<class K>(K) { return boundAs<K>(lo, hi, atoms_, list); });
}

FieldSample Field::sample(const DPoint3& p, AtomList list) const {
  return loops().sample(kernel_, atoms_, p, list);
}

}  // namespace pbrt::metaballs
