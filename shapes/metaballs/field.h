#pragma once
// The field of a set of atoms, f(x) = F(x) / T - 1 with F(x) = sum s_j W(|x - a_j|, h_j): the
// surface is f = 0, inside is f > 0. Scaling by the threshold leaves one number fewer to carry.

#include <span>
#include <vector>

#include "core/base/math.h"
#include "shapes/metaballs/kernel.h"

namespace pbrt::metaballs {

struct Atom {
  Point3 centre{};
  float radius = 1;  // of the support, h
  double inverseRadius = 1;
  double weight = 0;  // f of the atom is weight * K(r^2 / h^2)
};

// A set of atoms by their numbers.
using AtomList = std::span<const std::uint32_t>;

struct Interval {
  double lo = 0, hi = 0;

  bool contains(double x) const { return lo <= x && x <= hi; }
};

// The smallest interval that holds x and y, added to `sum`.
inline void addHull(Interval& sum, double x, double y) {
  sum.lo += std::min(x, y);
  sum.hi += std::max(x, y);
}

// Relative error of any one double operation, and of exp.
inline constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

// What shading asks for at a point.
struct FieldSample {
  double value = 0;
  DVec3 gradient{};
  glm::dmat3 hessian{0};
  std::uint32_t strongest = 0;  // the atom that adds most
};

class Field {
 public:
  Field(Kernel kernel, std::vector<Atom> atoms) : kernel_(kernel), atoms_(std::move(atoms)) {}

  Kernel kernel() const { return kernel_; }
  const std::vector<Atom>& atoms() const { return atoms_; }

  // All that follow take the atoms that reach the place in question; `list` may name others too.

  FieldSample sample(const DPoint3& p, AtomList list) const;
  // Holds f(x), as the real numbers define it, for every x of the box [lo, hi], rounding included.
  Interval bound(const DPoint3& lo, const DPoint3& hi, AtomList list) const;
  Interval bound(const DPoint3& p, AtomList list) const { return bound(p, p, list); }

 private:
  Kernel kernel_;
  std::vector<Atom> atoms_;
};

}  // namespace pbrt::metaballs
