#pragma once
// What surfels cling to: the surface on which a field is zero, and which may move.

#include <span>

#include "core/base/bounds.h"

namespace pbrt::surfels {

// The field at a point, and how the fluid moves there.
struct FieldAt {
  double value = -1;  // f: zero on the surface, above zero inside
  DVec3 gradient{};   // of f by place
  DVec3 flow{};       // velocity of the fluid about there, length per time (D_env)
};

// The gradient and its derivatives: what the surface looks like at a point.
struct ShapeAt {
  DVec3 gradient{};
  glm::dmat3 hessian{0};  // column i is the derivative of the gradient along axis i
};

// Answers are finite wherever they are asked for, also far from the surface, where f is below zero
// and the gradient may be zero. Const and thread-safe; nothing of at(), shape() and seeds()
// allocates or throws. Answers do not depend on which points are asked for together.
class MovingField {
 public:
  virtual ~MovingField() = default;

  // Holds the surface; empty: there is none.
  virtual Bounds3 bounds() const = 0;
  // Within so small a part of space the field is smooth: the smallest support radius, or some such
  // length. Above zero.
  virtual double grain() const = 0;
  // f within 1e-4 of what the real numbers say, where it matters: about its zeros.
  virtual void at(std::span<const DPoint3> points, std::span<FieldAt> out) const = 0;
  // The gradient within 1e-4 of itself; the Hessian within 1e-3 of itself, or such that curvatures
  // are within 1e-3 of what a ball as wide as the grain has.
  virtual void shape(std::span<const DPoint3> points, std::span<ShapeAt> out) const = 0;
  // Places near which to look for the surface: f is above zero at each, or it is on the surface
  // itself but for a small part of the grain. Number `first + i` gives out[i]; over many numbers
  // every part of the surface, and every piece that is apart from the rest, gets its share about as
  // it has a share in the area. False: none were found, `out` is not set.
  virtual bool seeds(std::uint64_t first, std::span<DPoint3> out) const = 0;
};

}  // namespace pbrt::surfels
