#pragma once
// The field of a set of atoms, f(x) = F(x) / T - 1 with F(x) = sum s_j W(|x - a_j|, h_j): the
// surface is f = 0, inside is f > 0. Scaling by the threshold leaves one number fewer to carry.

#include <limits>
#include <span>
#include <vector>

#include "core/api/implicit.h"
#include "shapes/metaballs/kernel.h"

namespace pbrt::metaballs {

// 32 bytes: two to a cache line.
struct Atom {
  Point3 centre{};
  float radius = 1;       // of the support, h
  double weight = 0;      // f of the atom is weight * K(r^2 / h^2)
  float lightWeight = 0;  // the same, rounded
  float inverse2 = 1;     // 1 / h^2, rounded

  Atom() = default;
  Atom(const Point3& c, float h, double w)
      : centre(c),
        radius(h),
        weight(w),
        lightWeight(static_cast<float>(w)),
        inverse2(1 / (h * h)) {}
};

// A set of atoms by their numbers.
using AtomList = std::span<const std::uint32_t>;

// Relative error of any one double operation.
inline constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

// What shading asks for at a point.
struct FieldSample {
  double value = 0;
  double error = 0;  // bound on the rounding of `value`
  DVec3 gradient{};
  glm::dmat3 hessian{0};
  // How far the gradient may be from this one at a distance e: bend * e + jump (as long as e is
  // below 2^-14 of every radius).
  double bend = 0, jump = 0;
  std::uint32_t strongest = 0;  // the atom that adds most
};

class Field {
 public:
  Field(Kernel kernel, std::vector<Atom> atoms);

  Kernel kernel() const { return kernel_; }
  const std::vector<Atom>& atoms() const { return atoms_; }
  // Whether some weight is negative.
  bool carves() const { return carves_; }
  float smallestRadius(AtomList list) const;

  // All that follow take the atoms that reach the place in question; `list` may name others too.

  FieldSample sample(const DPoint3& p, AtomList list) const;
  // Of f and its gradient over the box [lo, hi]: those of the atoms, each by itself, added up.
  FieldRange range(const DPoint3& lo, const DPoint3& hi, AtomList list) const;
  // Holds f(x), as the real numbers define it, for every x of the box [lo, hi], rounding included.
  Range bound(const DPoint3& lo, const DPoint3& hi, AtomList list) const;
  Range bound(const DPoint3& p, AtomList list) const { return bound(p, p, list); }

 private:
  Kernel kernel_;
  std::vector<Atom> atoms_;
  bool carves_ = false;
  bool alike_ = true;  // all radii are equal
};

}  // namespace pbrt::metaballs
